#include "simulate/stage_options.hpp"

#include <cmath>

#include "acoustics/hear_reverberation.hpp"
#include "beamforming/head_patterns.hpp"

namespace insonify {
namespace {

/// Elevations at which the pattern is down by more than this are not sampled.
constexpr double elevation_floor_db = -40;

/// Bent rays that arrive within this part of the elevation width of the straight ones sound the same.
constexpr double unseen_bend = 0.02;

}  // namespace

SamplingOptions sampling_options(const SonarHead& head, const Medium& medium, const SimulationOptions& o) {
  SamplingOptions s;
  s.kind = o.sampling;
  s.scatterers_per_cell = o.scatterers_per_cell;
  s.range_resolution = range_resolution(head.pulse, medium.sound_speed);
  s.rays_per_beam = o.rays_per_beam;
  s.elevation_half_extent = sampled_half_extent(head, elevation_floor_db);
  s.occlusion = o.occlusion;
  s.seed = o.seed;
  s.threads = o.threads;
  return s;
}

HearingOptions hearing_options(const SonarHead& head, const SimulationOptions& o) {
  HearingOptions h;
  h.amplitude = o.amplitude;
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

RefractionReport refract(const Environment& environment, const View& view, Scatterers& scatterers) {
  const SoundSpeedProfile& profile = *environment.profile;
  const double head_depth = environment.water.depth;
  RefractionReport report;
  report.bound = refraction_bound(profile, head_depth, view.world_from_head, scatterers);
  report.bent =
      report.bound.range >= view.gate.bin_size || report.bound.elevation >= unseen_bend * view.fan.elevation_width;
  if (report.bent)
    report.silenced = bend_paths(profile, head_depth, view.world_from_head, scatterers, view.sampling.threads);
  return report;
}

std::vector<Reverberation> hear_reverberation(const Environment& e, const View& view, const Transmission& sent,
                                              std::int64_t ping) {
  ReverberationOptions options;
  options.ping = ping;
  std::vector<Reverberation> heard;
  if (e.volume_scattering_db) heard.push_back({"volume", hear_volume(e, view.fan, view.gate, sent, options)});
  if (e.surface && e.surface->scattering_strength_db)
    heard.push_back({"surface", hear_surface(e, view.world_from_head, view.fan, view.gate, sent, options)});
  if (e.bottom && e.bottom->lambert_mu)
    heard.push_back({"bottom", hear_bottom(e, view.world_from_head, view.fan, view.gate, sent, options)});
  return heard;
}

}  // namespace insonify
