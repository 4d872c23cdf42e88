// SPDX-License-Identifier: BSD-3-Clause
// Echoes of a head from its images in mirrors, and from targets. All coordinates are in the axes of the head.
#include "acoustics/glints.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "acoustics/collect_echoes_internal.hpp"
#include "acoustics/edge_waves_internal.hpp"
#include "acoustics/find_legs_internal.hpp"
#include "acoustics/image_paths_internal.hpp"
#include "acoustics/reflection.hpp"
#include "acoustics/refracted_chain_internal.hpp"
#include "core/parallel.hpp"
#include "core/require.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;
using complex = std::complex<double>;

constexpr const char* glints = "glint_echoes";
constexpr double same_image = 1e-6;  // [m]

/// Adds the ways to a sphere or cylinder and back, if the head is in front of it.
void add_paths_to(const SmoothTarget& target, const Pose& to_head, double wavenumber, std::vector<ImagePath>& paths) {
  const Vector3d middle = to_head * target.surface.position, axis = to_head.linear() * target.axis;
  const auto add = [&](const Vector3d& returning, const Vector3d& reflects, complex factor, complex rise,
                       double grazing) {
    paths.push_back({2 * returning, 2 * returning, factor, {reflects}, {}, &target, edge_floor, rise});
    paths.back().scale(target.surface.reflection *
                       coherent_reflection_loss(wavenumber, target.surface.rms_height, grazing));  // (E152)
  };
  if (target.length > 0) {
    for (const BodyArrival& a : cylinder_arrivals(middle, axis, target.length, target.radius, wavenumber))
      add(a.apparent, a.position, a.factor, a.rise, a.grazing);
    return;
  }
  const double d = middle.norm() - target.radius;
  if (!(d > 0)) return;
  const Vector3d reflects = d / middle.norm() * middle;
  add(reflects, reflects, 1 / (1 + d / target.radius), 0, pi / 2);
}

std::vector<ImagePath> joined(const std::vector<ImagePath>& paths, const std::vector<std::uint8_t>& open) {
  std::vector<ImagePath> all;
  for (std::size_t w = 0; w < paths.size(); ++w) {
    if (!open[w]) continue;
    const auto same = std::find_if(all.begin(), all.end(), [&](const ImagePath& other) {
      return !other.target && !paths[w].target && (other.outgoing - paths[w].outgoing).norm() < same_image &&
             (other.returning - paths[w].returning).norm() < same_image;
    });
    if (same == all.end())
      all.push_back(paths[w]);
    else
      same->factor += paths[w].factor, same->rise += paths[w].rise;
  }
  return all;
}

/// The boundaries that mirrors are chained from; number of the first mirror.
std::pair<std::vector<Boundary>, std::size_t> all_boundaries(const SmoothShapes& shapes, const Environment& environment,
                                                             bool with_levels, const View& view,
                                                             const Transmission& outgoing) {
  std::vector<Boundary> all;
  if (with_levels)
    all = boundaries_of(environment, view.world_from_head, outgoing, MultipathOptions{}.boundary_tolerance, glints);
  const std::size_t first = all.size();
  for (Boundary& mirror : boundaries_of(shapes.mirrors, view.world_from_head, outgoing, glints))
    all.push_back(std::move(mirror));
  return {std::move(all), first};
}

/// The directions that legs by mirrors may have: the azimuths of the surfels, and elevations down to -80 dB one way.
SectorBounds directions_of_legs(const View& view, const Transmission& outgoing) {
  SamplingOptions sampling = view.sampling;
  sampling.elevation_half_extent = extent_of_legs(outgoing.echo_options);
  return SectorBounds(insonified_sector(view.fan, sampling));
}

/// Adds the echo of a way; and where it rises with frequency two more about it, which are opposite at the carrier and
/// the rise beside it (E179).
void add_echoes_of(const ImagePath& path, bool over_band, const Transmission& outgoing, Echoes& echoes) {
  constexpr double apart = 2;          // [rad] of the carrier, there and back, from the echo to either of the two
  constexpr double least_rise = 0.01;  // of the factor
  const double frequency = outgoing.pulse.centre_frequency, c = outgoing.medium.sound_speed;
  const double length = path.outgoing.norm(), cycles = frequency / c;
  const Vector3d out = path.outgoing / length, back = path.returning / length;
  const complex patterns = one_way_pattern(outgoing.echo_options, out.z()) *
                           one_way_pattern(outgoing.echo_options, back.z()) *
                           transmit_pattern(outgoing.echo_options, std::atan2(out.y(), out.x()));
  const complex gain = patterns * path.factor;
  if (!(std::norm(gain) >= path.least * path.least)) return;
  const complex carrier = std::polar(1 / length, 2 * pi * reduced_cycles(cycles * length));
  const auto add = [&](double later, complex size) {
    add_echo(echoes, (length + later) / c, back.y(), back.z(), source_pressure(outgoing.pulse) * size * carrier);
  };
  add(0, gain);
  if (!over_band || !(std::norm(path.rise) > least_rise * least_rise * std::norm(path.factor))) return;
  const double later = apart / (2 * pi * cycles);
  const complex half = patterns * path.rise / complex(0, 2 * apart);
  add(later, half), add(-later, -half);
}

/// The bent counterparts, in a profile, of ways by images.
class RefractedPathFinder {
 public:
  RefractedPathFinder(const Environment& environment, const View& view, const Transmission& outgoing)
      : direct_(*environment.profile, environment.water.depth, view.world_from_head, outgoing.medium.absorption.a0) {}

  /// Bends a way; returns false if no ray takes it.
  bool refract(ImagePath& path) const {
    constexpr double specular = 1e-6;  // part of the way: an image is twice as far as the position that reflects it
    const bool one_point = path.bounces.size() == 1;
    const bool to_image =
        one_point && !path.target && (path.outgoing - 2 * path.bounces[0]).norm() < specular * path.outgoing.norm();
    if (one_point && !to_image) return refract_to_point(path);

    if (!has_image(path)) return is_corner(path) || !reflects(path) ? refract_to_point(path) : refract_chain(path);
    std::optional<RefractedLegs> by_level;
    for (const Boundary* boundary : path.by)
      if (tilt_of(*boundary) == BoundaryTilt::level)
        by_level.emplace(direct_.mirrored(boundary->head_distance, boundary->plane.normal().z() < 0));
    const RefractedLegs& rays = by_level ? *by_level : direct_;
    const auto out = rays.to(path.outgoing), back = rays.to(path.returning);
    if (!out || !back) return false;
    path.outgoing = out->apparent, path.returning = back->apparent;
    path.scale(out->pressure);
    return true;
  }

 private:
  /// Both legs are the ray to the position; what the way is longer than that, its phase, stays.
  bool refract_to_point(ImagePath& path) const {
    const Vector3d position = path.bounces[0];
    const auto leg = direct_.to(position);
    if (!leg) return false;
    const double longer = 2 * (leg->apparent.norm() - position.norm());
    const Vector3d turned = leg->apparent.normalized() - position.normalized();
    for (Vector3d* end : {&path.outgoing, &path.returning})
      *end = (end->norm() + longer) * (end->normalized() + turned).normalized();
    path.scale(leg->pressure * leg->pressure);
    return true;
  }

  /// Returns true if the way is one ray to an image: by upright mirrors and one level boundary at most.
  static bool has_image(const ImagePath& path) {
    std::size_t levels = 0;
    for (const Boundary* boundary : path.by) {
      if (tilt_of(*boundary) == BoundaryTilt::tilted) return false;
      levels += tilt_of(*boundary) == BoundaryTilt::level;
    }
    return levels < 2;
  }

  /// Returns true if all bounces are in one position, where mirrors meet.
  static bool is_corner(const ImagePath& path) {
    constexpr double one_point = 1e-3;  // [m]
    return path.bounces.size() > 1 &&
           std::all_of(path.bounces.begin(), path.bounces.end(),
                       [&](const Vector3d& bounce) { return (bounce - path.bounces[0]).norm() < one_point; });
  }

  /// False for the edge of a single mirror, and if the ray that the mirror reflects would meet it beyond its edges.
  bool reflects(const ImagePath& path) const {
    if (path.by.size() > 1 || path.by[0]->corners.empty()) return true;
    constexpr double face_on = 1e-3;  // [rad]
    if (path.by[0]->normal.cross(path.bounces[0]).norm() > face_on * path.bounces[0].norm()) return false;
    const auto chain = refracted_chain(direct_, path.by, path.bounces, Vector3d::Zero());
    return !chain || path.by[0]->within_edges(chain->bounces[0]);
  }

  /// The way is the ray by its mirrors.
  bool refract_chain(ImagePath& path) const {
    const auto chain = refracted_chain(direct_, path.by, path.bounces, Vector3d::Zero());
    if (!chain) return false;
    Vector3d from = Vector3d::Zero();
    for (std::size_t k = 0; k < path.by.size(); ++k) {
      const Boundary& mirror = *path.by[k];
      const Vector3d straight = (path.bounces[k] - from).normalized();
      const complex before = mirror.reflection(std::asin(std::min(1.0, std::abs(mirror.normal.dot(straight)))));
      if (before != 0.0) path.scale(mirror.reflection(chain->grazing_on(mirror, k)) / before);
      from = path.bounces[k];
    }
    path.outgoing = chain->leg.apparent;
    path.returning = -chain->leg.apparent.norm() * chain->leg.arrival;
    path.scale(chain->leg.pressure);
    return true;
  }

  RefractedLegs direct_;
};

}  // namespace

Echoes glint_echoes(const SceneCloud& scene, const SmoothShapes& shapes, const Environment& environment,
                    bool with_levels, const View& view, const Transmission& outgoing, const GlintOptions& options) {
  require(options.most_bounces >= 0 && options.most_bounces <= 6, glints, "options.most_bounces", options.most_bounces,
          "", "within 0 and 6");
  const double frequency = outgoing.pulse.centre_frequency, c = outgoing.medium.sound_speed,
               margin = pulse_margin(outgoing);
  const auto [mirrors, first] = all_boundaries(shapes, environment, with_levels, view, outgoing);
  std::vector<ImagePath> paths = image_paths(mirrors, first, options.most_bounces);
  std::vector<Mirror> plates;
  for (const SmoothTarget& target : shapes.targets) {
    if (target.radius == 0)
      plates.push_back(target.surface);
    else
      add_paths_to(target, view.world_from_head.inverse(), 2 * pi * frequency / c, paths);
  }
  const std::vector<Boundary> planes = boundaries_of(plates, view.world_from_head, outgoing, glints);
  for (const Boundary& plane : planes)
    for (ImagePath& path : image_paths({&plane, 1}, 0, 1)) paths.push_back(std::move(path));
  const SectorBounds sector = directions_of_legs(view, outgoing);
  std::erase_if(paths, [&](const ImagePath& path) {
    const double range = 0.5 * path.outgoing.norm();
    return range < view.gate.min_range - margin || range > view.gate.max_range + margin ||
           !sector.holds(path.outgoing) || !sector.holds(path.returning);
  });

  Echoes echoes;
  const std::vector<std::uint8_t> open = unblocked_paths(scene, view, paths, outgoing.echo_options.threads);
  std::vector<ImagePath> returning = joined(paths, open);
  if (options.refraction && environment.profile) {
    const RefractedPathFinder refracted(environment, view, outgoing);
    const std::size_t unreached = std::erase_if(returning, [&](ImagePath& path) { return !refracted.refract(path); });
    if (options.unreached) *options.unreached = unreached;
  }
  for (const ImagePath& path : returning) add_echoes_of(path, options.over_band, outgoing, echoes);
  return echoes;  // (E151)
}

}  // namespace insonify
