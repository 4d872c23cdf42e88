// SPDX-License-Identifier: BSD-3-Clause
// Echoes that touch the sea surface, the bottom or a mirror, by the method of images (Jensen et al., Computational Ocean
// Acoustics, section 1.4; E48), one bounce per leg at most. Steps:
//   1. boundaries_of     surface, bottom and mirrors as planes in head axes, with their reflection
//   2. find_legs         for each surfel the legs, direct and by a boundary, that the scene leaves open: the head sees the
//                        scene mirrored in each boundary with the same visibility test as the scene itself
//   3. split_listed      patches of the surfels that only a boundary shows; those seen directly keep their patches
//   4. add_paths         for each patch every pair of legs, out and back, except the direct pair
// Cost: one visibility test of the scene per boundary, which dominates, and for n boundaries up to (n + 1)^2 - 1 paths of constant
// cost per patch (legs out x legs back, less the direct pair). Blocks of patches run in parallel and are joined in order.
#include "acoustics/multipath_echoes.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "acoustics/boundary_internal.hpp"
#include "acoustics/collect_echoes_internal.hpp"
#include "acoustics/find_legs_internal.hpp"
#include "acoustics/patch_legs_internal.hpp"
#include "core/error.hpp"
#include "core/require.hpp"
#include "core/units.hpp"
#include "sampling/seen_surfels.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;
using complex = std::complex<double>;

constexpr const char* me = "multipath_echoes";
constexpr std::size_t patches_per_block = 4096;

/// Where the echoes of one block came from, echo by echo.
struct Origins {
  std::vector<std::uint32_t> surfel;
  std::vector<LegPair> legs;
};

/// Makes the echoes of the patches of one list by all their paths.
class PathBuilder {
 public:
  PathBuilder(const SceneCloud& scene, const std::vector<Boundary>& boundaries, std::size_t first,
              const FoundLegs& found, const View& view, const Transmission& sent, const Environment* through)
      : scene_(scene),
        first_(first),
        patch_legs_(scene, boundaries, view, sent, through),
        found_(found),
        echo_options_(sent.echo_options),
        surfaces_(surfaces_of(sent, scene.materials)),
        source_(source_pressure(sent.pulse)),
        sound_speed_(sent.medium.sound_speed),
        cycles_per_m_(sent.pulse.centre_frequency / sent.medium.sound_speed) {
    const double margin = pulse_margin(sent);
    least_leg_ = 2 * (view.gate.min_range - margin);
    longest_leg_ = 2 * (view.gate.max_range + margin);
  }

  /// Adds the echoes of `patches` to `result`.
  /// parts        of each surfel, how many patches it was split into
  /// cosines      true if those of `patches` hold for the direct leg
  void add(const Scatterers& patches, const std::vector<std::uint32_t>& parts, bool cosines, Multipath& result) {
    patch_legs_.prepare(patches);
    std::atomic<std::size_t> two_bounces{0}, unreached{0};
    std::vector<Echoes> echoes(1);
    std::vector<Origins> origins((patches.size() + patches_per_block - 1) / patches_per_block);
    echoes[0] = collect_echoes(patches.size(), patches_per_block, echo_options_.threads,
                               [&](std::size_t begin, std::size_t end, Echoes& out) {
                                 Origins& from = origins[begin / patches_per_block];
                                 std::size_t twice = 0, lost = 0;
                                 std::vector<Leg> legs;
                                 for (std::size_t i = begin; i < end; ++i) {
                                   const std::uint32_t surfel = patches.surfel[i];
                                   if (!(found_.legs[surfel] & ~direct_leg)) continue;
                                   lost += patch_legs_.find(patches, i, found_.legs[surfel], cosines, legs);
                                   if (legs.empty()) continue;
                                   const double area = static_cast<double>(scene_.area[surfel]) / parts[surfel];
                                   add_paths(legs, patches, i, area, out, from);
                                   from.surfel.resize(out.size(), surfel);
                                 }
                                 for (const LegPair pair : from.legs) twice += pair.bounces() == 2;
                                 two_bounces += twice, unreached += lost;
                               });
    result.two_bounces += two_bounces, result.unreached += unreached;
    result.one_bounce += echoes[0].size() - two_bounces;
    join_echoes(std::move(echoes), result.echoes);
    for (const Origins& from : origins) {
      result.surfel.insert(result.surfel.end(), from.surfel.begin(), from.surfel.end());
      result.legs.insert(result.legs.end(), from.legs.begin(), from.legs.end());
    }
  }

 private:
  void add_paths(const std::vector<Leg>& legs, const Scatterers& patches, std::size_t patch, double area, Echoes& out,
                 Origins& from) const {
    const std::size_t material = patches.material[patch];
    const complex amplitude =
        source_ * surface_amplitude(echo_options_, scene_.materials[material].coherent_fraction, patches.id[patch]);
    for (const Leg& there : legs)
      for (const Leg& back : legs) {
        const double length = there.range + back.range;
        if (std::max(there.by, back.by) < first_ || length < least_leg_ || length > longest_leg_) continue;
        const complex gain = there.sent * back.gain;
        if (!(std::norm(gain) >= echo_floor * echo_floor)) continue;
        from.legs.push_back({there.by, back.by});
        const double phase = 2 * pi * reduced_cycles(cycles_per_m_ * length);
        const double sigma = cross_section(*surfaces_[material], {there.cosine, back.cosine, there.cosine * area,
                                                                  std::min(1.0, there.towards.dot(back.towards))});
        const double size = std::sqrt(sigma) / (there.range * back.range);
        add_echo(out, length / sound_speed_, back.u, back.v, amplitude * gain * std::polar(size, phase));  // (E48)
      }
  }

  const SceneCloud& scene_;
  std::size_t first_;  // number of the first boundary without which an echo does not count
  PatchLegs patch_legs_;
  const FoundLegs& found_;
  const EchoOptions& echo_options_;
  SurfaceTable surfaces_;
  double source_, sound_speed_, cycles_per_m_, least_leg_ = 0, longest_leg_ = 0;
};

/// The view as far as legs up to `max_range` may lead out of it and still belong to an echo inside the gate.
View widened(const View& view, double max_range, const Transmission& sent) {
  View wide = view;
  wide.gate = {1e-3 * view.gate.min_range, max_range, view.gate.bin_size * max_range / view.gate.max_range};
  wide.sampling.elevation_half_extent = extent_of_legs(sent.echo_options);
  return wide;
}

std::vector<std::uint32_t> pieces_per_surfel(const Scatterers& patches, std::size_t surfels) {
  std::vector<std::uint32_t> parts(surfels, 0);
  for (const std::uint32_t surfel : patches.surfel) {
    if (surfel >= surfels)
      fail(ErrorKind::argument, me, ": direct.surfel = ", surfel, ", but the scene has ", surfels, " surfels");
    ++parts[surfel];
  }
  return parts;
}

/// Surfels that only a boundary shows, or all that one shows if `direct` holds rays, which are not patches.
std::vector<std::uint32_t> surfels_beside(const FoundLegs& found, const std::vector<std::uint8_t>& seen_directly) {
  std::vector<std::uint32_t> list;
  for (std::uint32_t i = 0; i < seen_directly.size(); ++i)
    if (!seen_directly[i] && (found.legs[i] & ~direct_leg)) list.push_back(i);
  return list;
}

/// The boundaries of a ping. An echo counts if at least one leg goes by boundary `first` or a later one.
struct Bounces {
  const std::vector<Boundary>& boundaries;
  std::size_t first;
  double longest;              ///< longest leg [m]
  const Environment* through;  ///< water that bends the legs; null: straight legs
};

Multipath bounced_echoes(const SceneCloud& scene, const Scatterers& direct, const Bounces& bounces, const View& view,
                         const Transmission& sent) {
  const auto& [boundaries, first, longest, through] = bounces;
  if (boundaries.size() > most_boundaries)
    fail(ErrorKind::argument, me, ": ", boundaries.size(), " planes, must be at most ", most_boundaries);
  Multipath result;
  for (const Boundary& boundary : boundaries) result.planes.push_back(boundary.plane);

  const bool rays = view.sampling.kind == SamplingKind::rays;
  const auto parts = pieces_per_surfel(direct, scene.size());
  std::vector<std::uint8_t> seen_directly(scene.size(), 0);
  for (std::size_t i = 0; i < scene.size() && !rays; ++i) seen_directly[i] = parts[i] > 0;
  const FoundLegs found = find_legs(scene, widened(view, longest, sent), boundaries, seen_directly);
  result.blocked = found.hidden;

  // Paths, patch by patch: first those seen directly, then those that only a boundary shows.
  PathBuilder builder(scene, boundaries, first, found, view, sent, through);
  if (!rays) builder.add(direct, parts, true, result);
  const Scatterers beside = split_listed(scene, view.world_from_head, view.fan, view.gate,
                                         surfels_beside(found, seen_directly), view.sampling);
  builder.add(beside, pieces_per_surfel(beside, scene.size()), false, result);
  return result;
}

void require_arguments(const SceneCloud& scene, const Environment& environment, const View& view,
                       const Transmission& transmission, const MultipathOptions& options) {
  require_valid(scene, me);
  require_valid(environment, me);
  require_valid(view.gate, me);
  require_valid(transmission.pulse, me);
  require_valid(transmission.medium, me);
  require(options.boundary_tolerance >= 0 && std::isfinite(options.boundary_tolerance), me,
          "options.boundary_tolerance", options.boundary_tolerance, "m", "finite and >= 0");
}

}  // namespace

Multipath multipath_echoes(const SceneCloud& scene, const Scatterers& direct, const Environment& environment,
                           const View& view, const Transmission& transmission, const MultipathOptions& options) {
  require_arguments(scene, environment, view, transmission, options);
  const auto boundaries =
      boundaries_of(environment, view.world_from_head, transmission, options.boundary_tolerance, me);
  return bounced_echoes(
      scene, direct,
      {boundaries, 1, longest_leg(environment, {}, view, transmission), options.refraction ? &environment : nullptr},
      view, transmission);
}

Multipath mirror_echoes(const SceneCloud& scene, const Scatterers& direct, const Environment& environment,
                        std::span<const Mirror> mirrors, bool with_levels, const View& view,
                        const Transmission& transmission, const MultipathOptions& options) {
  require_arguments(scene, environment, view, transmission, options);
  for (const Mirror& mirror : mirrors) require_valid(mirror, me);
  std::vector<Boundary> boundaries;
  if (with_levels)
    boundaries = boundaries_of(environment, view.world_from_head, transmission, options.boundary_tolerance, me);
  const std::size_t first = boundaries.size() + 1;
  for (Boundary& boundary : boundaries_of(mirrors, view.world_from_head, transmission, me))
    boundaries.push_back(std::move(boundary));
  return bounced_echoes(scene, direct,
                        {boundaries, first, longest_leg(environment, mirrors, view, transmission),
                         options.refraction ? &environment : nullptr},
                        view, transmission);
}

void append(Echoes& echoes, const Echoes& more) {
  if (!echoes.doppler.empty() || !more.doppler.empty()) {
    echoes.doppler.resize(echoes.size());
    for (std::size_t i = 0; i < more.size(); ++i) echoes.doppler.push_back(more.doppler_of(i));
  }
  const auto add = [](auto& all, const auto& others) { all.insert(all.end(), others.begin(), others.end()); };
  add(echoes.delay, more.delay), add(echoes.u, more.u), add(echoes.v, more.v), add(echoes.amplitude, more.amplitude);
}

double longest_leg(const Environment& environment, std::span<const Mirror> mirrors, const View& view,
                   const Transmission& transmission) {
  const double head = view.world_from_head.translation().z();
  double farthest = 0;
  if (environment.surface) farthest = std::max(farthest, std::abs(head - environment.surface->height));
  if (environment.bottom) farthest = std::max(farthest, std::abs(head - environment.bottom->height));
  for (const Mirror& m : mirrors)
    farthest = std::max(farthest,
                        MirrorPlane(m.normal.normalized(), m.position).absDistance(view.world_from_head.translation()));
  return view.gate.max_range + pulse_margin(transmission) + farthest;
}

double strongest_bounce(const Environment& environment, const View& view, const Transmission& transmission) {
  require_valid(environment, "strongest_bounce");
  if (!environment.surface && !environment.bottom) return 0;
  const auto boundaries = boundaries_of(environment, view.world_from_head, transmission, 0, "strongest_bounce");
  const double range = longest_leg(environment, {}, view, transmission);
  double most = 0;
  for (const Boundary& b : boundaries) most = std::max(most, b.strongest_bounce(range));
  return most;
}

}  // namespace insonify
