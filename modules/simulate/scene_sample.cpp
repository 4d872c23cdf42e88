// Echo power of an evenly strided sample of the scene, by where the surfels stand: incoherent sums of the direct echo
// (E4, E7, E14) without occlusion, from which the plan derives its bounds and its estimates of surfels and scatterers.
#include <algorithm>
#include <cmath>

#include "acoustics/scattering.hpp"
#include "core/units.hpp"
#include "simulate/scene_sample_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t most_sampled = 20000;

/// Adds up one surfel after another.
class Sampler {
 public:
  Sampler(const SceneCloud& scene, const ResolvedPing& ping)
      : scene_(scene),
        ping_(ping),
        gate_(ping.view.gate),
        sector_(ping.sector),
        to_head_(ping.view.world_from_head.linear().transpose()),
        shift_(scene.origin - ping.view.world_from_head.translation()),
        source_(source_pressure(ping.head.pulse)) {}

  void add(std::size_t i) {
    const Eigen::Vector3d p = to_head_ * (shift_ + scene_.point[i].cast<double>());
    const double r = p.norm();
    if (r < 1e-3) return;
    const double cosine = -(to_head_ * scene_.normal[i].cast<double>()).dot(p) / r;
    const double facing = scene_.normals_oriented ? std::max(0.0, cosine) : std::abs(cosine);
    const Direction d = direction_of(p);
    const bool in_azimuth = sector_.in_cones(p), in_elevation = sector_.in_elevations(p);
    const bool in_gate = r >= gate_.min_range && r <= gate_.max_range;

    const double power = echo_power(i, r, facing, d.elevation);
    if (in_gate && in_azimuth && !in_elevation) sums_.off_elevation += power;
    if (in_gate && in_elevation && !in_azimuth) sums_.off_azimuth += power;
    if (!in_gate && in_azimuth && in_elevation) sums_.beyond_gate += power * left_in_gate(r);
    if (in_gate && in_azimuth && in_elevation) add_in_view(i, {r, d.azimuth, d.elevation}, facing, power);
  }

  /// The sums, with the numbers of surfels and scatterers scaled from `sampled` surfels to the scene.
  SceneSample finish(double sampled) {
    const double scale = static_cast<double>(scene_.size()) / sampled;
    sums_.surfels = static_cast<std::size_t>(surfels_ * scale);
    sums_.back_facing = static_cast<std::size_t>(back_facing_ * scale);
    sums_.scatterers *= scale;
    return std::move(sums_);
  }

 private:
  struct Place {
    double range, azimuth, elevation;
  };

  /// |echo|^2 by the pattern, and, for the sum over the scene, without it and broadside.
  double echo_power(std::size_t i, double r, double facing, double elevation) {
    const double pattern = elevation_pattern(ping_.sent.echo_options, elevation);
    const double amplitude = source_ * std::exp(-2 * ping_.sent.medium.absorption.a0 * r) / (r * r);
    const Material& material = scene_.materials[scene_.material[i]];
    const double area = scene_.area[i], frequency = ping_.head.pulse.centre_frequency;
    sums_.anywhere += cross_section(material, {1, 1, area}, frequency) * amplitude * amplitude;
    return cross_section(material, {facing, facing, facing * area}, frequency) * amplitude * amplitude * pattern *
           pattern;
  }

  /// What a pulse from beyond the gate still has inside it: a Gaussian, cut where the sampled ranges end.
  double left_in_gate(double r) const {
    const RangeGate& gate = ping_.head.gate;
    const double reach = gate_.max_range - gate.max_range;
    const double gap = r > gate_.max_range ? r - gate.max_range : gate.min_range - r;
    return std::pow(0.5 * ping_.options.synthesis.tolerance, 2 * std::pow(std::max(1.0, gap / reach), 2));
  }

  void add_in_view(std::size_t i, const Place& place, double facing, double power) {
    if (!(facing > 0)) {
      ++back_facing_;
      return;
    }
    ++surfels_;
    sums_.in_view += power;
    sums_.places.range.push_back(place.range);
    sums_.places.azimuth.push_back(place.azimuth);
    sums_.places.elevation.push_back(place.elevation);
    sums_.in_view_farthest = std::max(sums_.in_view_farthest, place.range);
    sums_.in_view_nearest = sums_.in_view_nearest > 0 ? std::min(sums_.in_view_nearest, place.range) : place.range;
    const SamplingOptions& sampling = ping_.view.sampling;
    const double sine = std::sqrt(std::max(0.0, 1 - facing * facing)), cell_length = sampling.range_resolution;
    const double length = std::min(cell_length / std::max(sine, 1e-6), 2 * std::sqrt(2 * place.range * cell_length));
    sums_.scatterers += std::max(1.0, sampling.scatterers_per_cell * static_cast<double>(scene_.area[i]) /
                                          (length * place.range * ping_.head.fan.beam_width));
  }

  const SceneCloud& scene_;
  const ResolvedPing& ping_;
  const RangeGate& gate_;  // the sampled one
  SectorBounds sector_;
  Eigen::Matrix3d to_head_;
  Eigen::Vector3d shift_;
  double source_, surfels_ = 0, back_facing_ = 0;
  SceneSample sums_;
};

}  // namespace

SceneSample sample_scene(const SceneCloud& scene, const ResolvedPing& ping) {
  if (scene.size() == 0) return {};
  Sampler sampler(scene, ping);
  const std::size_t step = (scene.size() + most_sampled - 1) / most_sampled;
  double sampled = 0;
  for (std::size_t i = step / 2; i < scene.size(); i += step, ++sampled) sampler.add(i);
  return sampler.finish(sampled);
}

}  // namespace insonify
