#include <algorithm>
#include <cmath>

#include "acoustics/reverberation_echoes.hpp"
#include "beamforming/head_patterns.hpp"
#include "core/units.hpp"
#include "simulate/stage_options_internal.hpp"

namespace insonify {
namespace {

/// Nothing nearer is heard [m]: spreading would know no bounds.
constexpr double nearest_range = 0.1;

/// Bent rays that arrive within this part of the elevation width of the straight ones sound the same.
constexpr double unseen_bend = 0.02;

}  // namespace

SamplingOptions sampling_options(const SonarHead& head, const Medium& medium, const SimulationOptions& o) {
  SamplingOptions s;
  s.kind = o.sampling;
  s.scatterers_per_cell = o.scatterers_per_cell;
  s.range_resolution = range_resolution(head.pulse, medium.sound_speed);
  s.rays_per_beam = o.rays_per_beam;
  s.elevation_half_extent = sampled_half_extent(head, o.elevation_floor_db);
  s.azimuth_margin = o.azimuth_margin;
  s.occlusion = o.occlusion;
  s.seed = o.seed;
  s.threads = o.threads;
  return s;
}

EchoOptions echo_options_of(const SonarHead& head, const SimulationOptions& o) {
  EchoOptions h;
  h.amplitude = o.method == SynthesisMethod::incoherent ? SurfaceAmplitude::mean_power : o.amplitude;
  h.seed = o.seed;
  h.threads = o.threads;
  return with_patterns(h, head);
}

DetectionOptions detection_options(const SonarHead& head, const Environment& environment, const SimulationOptions& o) {
  DetectionOptions d = o.detection;
  d.threads = o.threads;
  if (std::isinf(d.noise_floor_db))
    d.noise_floor_db = element_noise_level_db(environment, head.pulse) - array_gain_db(head);
  return d;
}

double largest_area(const SceneCloud& scene) {
  if (scene.part_of) return scene.part_of->largest_area;
  return scene.area.empty() ? 0.0 : *std::max_element(scene.area.begin(), scene.area.end());
}

RangeGate sampled_gate(double largest_area, const SonarHead& head, const Medium& medium,
                       const SimulationOptions& options) {
  const double widest = head.gate.max_range - head.gate.min_range;  // more is no part of a scene that a ping could use
  const double part = std::min(widest, std::sqrt(largest_area / pi));
  const double reach = part + 0.5 * medium.sound_speed * pulse_half_length(head.pulse, 0.5 * options.tolerance);
  RangeGate gate = head.gate;
  gate.min_range = std::max(std::min(nearest_range, gate.min_range), gate.min_range - reach);
  gate.max_range += reach;
  return gate;
}

View view_of(double largest_area, const SonarHead& head, const Pose& world_from_head, const Medium& medium,
             const SimulationOptions& options) {
  return {world_from_head, head.fan, sampled_gate(largest_area, head, medium, options),
          sampling_options(head, medium, options)};
}

RefractionReport refract(const Environment& environment, const View& view, Choice choice, double bin_size,
                         Scatterers& scatterers) {
  const SoundSpeedProfile& profile = *environment.profile;
  const double head_depth = environment.water.depth;
  RefractionReport report;
  report.bound = refraction_bound(profile, head_depth, view.world_from_head, scatterers);
  const bool needed =
      report.bound.range >= bin_size || report.bound.elevation >= unseen_bend * view.fan.elevation_width;
  report.bent = choice == Choice::always || (choice == Choice::as_needed && needed);
  if (report.bent)
    report.silenced = bend_paths(profile, head_depth, view.world_from_head, scatterers, view.sampling.threads);
  return report;
}

std::vector<Reverberation> reverberation_echoes(const Environment& e, const View& view, const Transmission& sent,
                                                std::int64_t ping) {
  ReverberationOptions options;
  options.ping = ping;
  std::vector<Reverberation> heard;
  if (e.volume_scattering_db) heard.push_back({"volume", volume_echoes(e, view.fan, view.gate, sent, options)});
  if (e.surface && e.surface->scattering_strength_db)
    heard.push_back({"surface", surface_echoes(e, view.world_from_head, view.fan, view.gate, sent, options)});
  if (e.bottom && e.bottom->lambert_mu)
    heard.push_back({"bottom", bottom_echoes(e, view.world_from_head, view.fan, view.gate, sent, options)});
  return heard;
}

}  // namespace insonify
