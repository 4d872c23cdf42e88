// SPDX-License-Identifier: BSD-3-Clause
// Echoes by way of two rough surfaces, by rays from surface to surface (Veach 1997, chapter 8: light transport by
// importance sampling; with the phases of sound). Steps, block by block of the surfels seen:
//   1. rays_from    so many rays as the surfel's share of the resolution cells asks for
//   2. draw_ray     start in the surfel and direction, with its density of probability
//   3. add_pair     the surface met, both cross-sections, and the two echoes of the pair
#include "acoustics/double_echoes.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>

#include "acoustics/collect_echoes_internal.hpp"
#include "core/random.hpp"
#include "core/require.hpp"
#include "core/units.hpp"
#include "scene/surface_rays.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;
using complex = std::complex<double>;

constexpr double least_gain = 1e-4;  // -80 dB: what patterns may leave of an echo
constexpr double nearest = 1e-3;     // [m]: spreading has no bound nearer to the head
constexpr std::size_t surfels_per_block = 2048;

/// The leg between the head and a place on a surface.
struct HeadLeg {
  Vector3d to_head;   ///< unit vector from the place, world axes
  double range;       ///< [m]
  double u, v;        ///< of the place, direction cosines
  double gain, sent;  ///< one-way pattern; with the transmitter's in azimuth
};

/// A ray that leaves a surfel, with the density of probability [1/sr] of its direction.
struct DrawnRay {
  Vector3d from, direction;  ///< world axes; `from` relative to the scene's origin
  double pdf = 0;
};

class PairBuilder {
 public:
  PairBuilder(const PreparedScene& prepared, std::span<const std::uint32_t> seen, const View& view,
              const Transmission& sent, const DoubleEchoOptions& options)
      : scene_(prepared.scene()),
        rays_(prepared.rays(view.sampling.footprint)),
        laws_(surfaces_of(sent, scene_.materials)),
        options_(sent.echo_options),
        head_(view.world_from_head.translation() - scene_.origin),
        to_head_(view.world_from_head.linear().transpose()),
        source_(source_pressure(sent.pulse)),
        sound_speed_(sent.medium.sound_speed),
        cycles_per_m_(sent.pulse.centre_frequency / sent.medium.sound_speed),
        seen_(scene_.size(), false) {
    const double margin = 0.5 * sound_speed_ * pulse_half_length(sent.pulse, pulse_floor);
    least_path_ = 2 * (view.gate.min_range - margin), longest_path_ = 2 * (view.gate.max_range + margin);
    cells_ = options.rays_per_cell / (view.fan.beam_width * range_resolution(sent.pulse, sound_speed_));
    for (const std::uint32_t i : seen) seen_[i] = true;
  }

  /// Adds the echoes of the rays from surfel i; returns how many rays it sent.
  std::size_t add(std::uint32_t i, Echoes& echoes, std::vector<std::uint32_t>& ends) const {
    const Vector3d place = scene_.point[i].cast<double>();
    const double rays = cells_ * scene_.area[i] / (head_ - place).norm();
    const double whole =
        std::floor(rays + random_uniform(options_.seed, RandomStage::surface_ray, {scene_.id[i], 0, 1})[0]);
    const auto count = static_cast<std::size_t>(whole);
    for (std::size_t k = 0; k < count; ++k) add_pair(i, k, rays, echoes, ends);
    return count;
  }

 private:
  Vector3d normal_of(std::uint32_t i, const Vector3d& towards) const {
    const Vector3d normal = scene_.normal[i].cast<double>();
    return !scene_.normals_oriented && normal.dot(towards) < 0 ? -normal : normal;
  }

  HeadLeg leg_to(const Vector3d& place) const {
    HeadLeg leg;
    const Vector3d from_head = place - head_;
    leg.range = from_head.norm();
    leg.to_head = -from_head / leg.range;
    const Vector3d direction = to_head_ * from_head / leg.range;
    leg.u = direction.y(), leg.v = direction.z();
    leg.gain = std::sqrt(std::abs(elevation_pattern(options_, std::asin(std::clamp(leg.v, -1.0, 1.0)))));
    leg.sent = leg.gain * transmit_pattern(options_, std::atan2(direction.y(), direction.x()));
    return leg;
  }

  /// The k-th ray from surfel i; of density 0 if it points below the surface.
  DrawnRay draw_ray(std::uint32_t i, std::size_t k, const Vector3d& normal, double slope) const {
    const auto [radius, turn, number, angle] =
        random_uniform(options_.seed, RandomStage::surface_ray, {scene_.id[i], k, 0});
    Eigen::Matrix3d from_surface;  // along, across and off the surface
    from_surface.col(0) = normal.unitOrthogonal(), from_surface.col(2) = normal;
    from_surface.col(1) = normal.cross(from_surface.col(0));
    DrawnRay ray;
    ray.from = scene_.point[i].cast<double>() +
               std::sqrt(radius * scene_.area[i] / pi) *
                   (std::cos(2 * pi * turn) * from_surface.col(0) + std::sin(2 * pi * turn) * from_surface.col(1));
    const Vector3d to_head = (head_ - ray.from).normalized();
    const Vector3d in = from_surface.transpose() * to_head;
    if (!(in.z() > 0)) return ray;
    const Vector3d out = sampled_direction(slope, in, number, angle);
    ray.direction = from_surface * out;
    if (out.z() > 0) ray.pdf = sampling_density(slope, {in.z(), out.z(), in.dot(out)});
    return ray;
  }

  void add_pair(std::uint32_t i, std::size_t k, double rays, Echoes& echoes, std::vector<std::uint32_t>& ends) const {
    const SurfaceScattering& law = *laws_[scene_.material[i]];
    const Vector3d normal = normal_of(i, head_ - scene_.point[i].cast<double>());
    const DrawnRay ray = draw_ray(i, k, normal, law.lobe_slope());
    if (!(ray.pdf > 0)) return;
    const SurfaceHit hit = rays_.first_hit({i, ray.from.cast<float>(), ray.direction.cast<float>()});
    if (hit.surfel == SurfaceHit::none || !seen_[hit.surfel]) return;

    // Both surfaces, met from the other one and from the head.
    const HeadLeg out = leg_to(ray.from), back = leg_to(ray.from + hit.distance * ray.direction);
    const Vector3d normal_there = normal_of(hit.surfel, back.to_head);
    const PathAngles here{normal.dot(out.to_head), normal.dot(ray.direction), out.to_head.dot(ray.direction)};
    const PathAngles there{-normal_there.dot(ray.direction), normal_there.dot(back.to_head),
                           -ray.direction.dot(back.to_head)};
    if (!(there.cos_in > 0 && there.cos_out > 0 && std::min(out.range, back.range) > nearest)) return;
    const double weight = law.cross_section(here) * scene_.area[i] *
                          laws_[scene_.material[hit.surfel]]->cross_section(there) * hit.density /
                          (rays * ray.pdf * there.cos_in);  // (E159)
    const double path = out.range + hit.distance + back.range;
    if (!(weight > 0) || path < least_path_ || path > longest_path_) return;

    // One echo for each sense.
    const double phase = 2 * pi * reduced_cycles(cycles_per_m_ * path);
    const complex amplitude =
        source_ * xi(i, k) * std::polar(std::sqrt(0.5 * weight) / (out.range * back.range), phase);
    add_sense(out, back, path, amplitude, {i, hit.surfel}, echoes, ends);
    add_sense(back, out, path, amplitude, {hit.surfel, i}, echoes, ends);
  }

  void add_sense(const HeadLeg& out, const HeadLeg& back, double path, complex amplitude,
                 std::array<std::uint32_t, 2> from_to, Echoes& echoes, std::vector<std::uint32_t>& ends) const {
    const double gain = out.sent * back.gain;
    if (!(gain >= least_gain)) return;
    add_echo(echoes, path / sound_speed_, back.u, back.v, amplitude * gain);  // (E158)
    ends.insert(ends.end(), from_to.begin(), from_to.end());
  }

  /// The random number of a pair.
  complex xi(std::uint32_t i, std::size_t k) const {
    if (options_.amplitude == SurfaceAmplitude::coherent || options_.amplitude == SurfaceAmplitude::mean_power)
      return 1;
    const complex z = random_complex_normal(options_.seed, RandomStage::double_echo, {scene_.id[i], k, 0});
    return options_.amplitude == SurfaceAmplitude::random_phase ? z / std::abs(z) : z;
  }

  const SceneCloud& scene_;
  const SurfaceRays& rays_;
  SurfaceTable laws_;
  const EchoOptions& options_;
  Vector3d head_;  // relative to the scene's origin
  Eigen::Matrix3d to_head_;
  double source_, sound_speed_, cycles_per_m_, least_path_ = 0, longest_path_ = 0;
  double cells_ = 0;  // rays [1/m]: times area, over range
  std::vector<bool> seen_;
};

}  // namespace

DoubleEchoes double_echoes(const PreparedScene& prepared, std::span<const std::uint32_t> seen, const View& view,
                           const Transmission& sent, const DoubleEchoOptions& options) {
  const SceneCloud& scene = prepared.scene();
  require(options.rays_per_cell >= 1e-6 && options.rays_per_cell <= 1e4, "double_echoes", "rays_per_cell",
          options.rays_per_cell, "", "within 1e-6 and 1e4");
  for (const std::uint32_t i : seen)
    if (i >= scene.size())
      fail(ErrorKind::argument, "double_echoes: seen holds ", i, ", but the scene has ", scene.size(), " surfels");
  DoubleEchoes result;
  if (seen.empty()) return result;
  const PairBuilder builder(prepared, seen, view, sent, options);
  std::vector<std::vector<std::uint32_t>> ends((seen.size() + surfels_per_block - 1) / surfels_per_block);
  std::atomic<std::size_t> rays{0};
  result.echoes = collect_echoes(seen.size(), surfels_per_block, sent.echo_options.threads,
                                 [&](std::size_t begin, std::size_t end, Echoes& echoes) {
                                   std::size_t sent_here = 0;
                                   for (std::size_t k = begin; k < end; ++k)
                                     sent_here += builder.add(seen[k], echoes, ends[begin / surfels_per_block]);
                                   rays += sent_here;
                                 });
  result.rays = rays;
  for (const std::vector<std::uint32_t>& of_block : ends)
    for (std::size_t k = 0; k < of_block.size(); k += 2)
      result.first.push_back(of_block[k]), result.last.push_back(of_block[k + 1]);
  return result;
}

}  // namespace insonify
