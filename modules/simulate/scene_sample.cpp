#include <algorithm>
#include <cmath>

#include "beamforming/head_patterns.hpp"
#include "core/units.hpp"
#include "simulate/scene_sample_internal.hpp"
#include "simulate/stage_options_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t most_looked_at = 20000;

}  // namespace

SceneSample sample_scene(const SceneCloud& scene, const SonarHead& head, const Pose& pose, const Medium& medium,
                         const SimulationOptions& options) {
  SceneSample sample;
  if (scene.size() == 0) return sample;
  const SamplingOptions sampling = sampling_options(head, medium, options);
  const EchoOptions echo_options = with_patterns({}, head);
  const SectorBounds sector(insonified_sector(head.fan, sampling.elevation_half_extent, sampling.azimuth_margin));
  const RangeGate gate = sampled_gate(largest_area(scene), head, medium, options);
  const double reach = gate.max_range - head.gate.max_range;
  const Eigen::Matrix3d to_head = pose.linear().transpose();
  const Eigen::Vector3d shift = scene.origin - pose.translation();
  const double source = source_pressure(head.pulse), cell_length = sampling.range_resolution;

  const std::size_t step = (scene.size() + most_looked_at - 1) / most_looked_at;
  double looked_at = 0, surfels = 0, back_facing = 0;
  for (std::size_t i = step / 2; i < scene.size(); i += step, ++looked_at) {
    const Eigen::Vector3d p = to_head * (shift + scene.point[i].cast<double>());
    const double r = p.norm();
    if (r < 1e-3) continue;
    const double cosine = -(to_head * scene.normal[i].cast<double>()).dot(p) / r;
    const double facing = scene.normals_oriented ? std::max(0.0, cosine) : std::abs(cosine);
    const Direction d = direction_of(p);
    const bool in_azimuth = sector.in_cones(p), in_elevation = sector.in_elevations(p);
    const bool in_gate = r >= gate.min_range && r <= gate.max_range;
    const double pattern = echo_options.elevation_width > 0
                               ? elevation_response(echo_options.elevation_shape, echo_options.elevation_width,
                                                    d.elevation - echo_options.elevation_centre)
                               : 1;
    const double amplitude = source * std::exp(-2 * medium.absorption.a0 * r) / (r * r);
    const double sigma = lambert_cross_section(scene.materials[scene.material[i]].lambert_mu, facing,
                                               facing * static_cast<double>(scene.area[i]));
    const double power = sigma * amplitude * amplitude * pattern * pattern;
    sample.anywhere +=
        lambert_cross_section(scene.materials[scene.material[i]].lambert_mu, 1, scene.area[i]) * amplitude * amplitude;
    if (in_gate && in_azimuth && !in_elevation) sample.off_elevation += power;
    if (in_gate && in_elevation && !in_azimuth) sample.off_azimuth += power;
    if (!in_gate && in_azimuth && in_elevation) {
      // What a pulse from there still has inside the gate: a Gaussian, cut where the sampled ranges end.
      const double gap = r > gate.max_range ? r - head.gate.max_range : head.gate.min_range - r;
      sample.beyond_gate += power * std::pow(0.5 * options.tolerance, 2 * std::pow(std::max(1.0, gap / reach), 2));
    }
    if (!(in_gate && in_azimuth && in_elevation)) continue;
    surfels += facing > 0;
    back_facing += !(facing > 0);
    if (!(facing > 0)) continue;
    sample.in_view += power;
    sample.places.range.push_back(r);
    sample.places.azimuth.push_back(d.azimuth);
    sample.places.elevation.push_back(d.elevation);
    sample.in_view_farthest = std::max(sample.in_view_farthest, r);
    sample.in_view_nearest = sample.in_view_nearest > 0 ? std::min(sample.in_view_nearest, r) : r;
    const double sine = std::sqrt(std::max(0.0, 1 - facing * facing));
    const double length = std::min(cell_length / std::max(sine, 1e-6), 2 * std::sqrt(2 * r * cell_length));
    sample.scatterers += std::max(
        1.0, options.scatterers_per_cell * static_cast<double>(scene.area[i]) / (length * r * head.fan.beam_width));
  }
  const double scale = static_cast<double>(scene.size()) / looked_at;
  sample.surfels = static_cast<std::size_t>(surfels * scale);
  sample.back_facing = static_cast<std::size_t>(back_facing * scale);
  sample.scatterers *= scale;
  return sample;
}

}  // namespace insonify
