// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/resolve_ping.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "beamforming/engine.hpp"
#include "beamforming/head_patterns.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "returns/looks.hpp"
#include "sonar/receive_array.hpp"

namespace insonify {
namespace {

constexpr double nearest_range = 0.1;                 // range [m] nearer than which spreading has no bound
constexpr double nothing_db = -400;                   // level of a pattern [dB] that is nothing
constexpr double scatterers_per_display_cell = 0.75;  // patches in a cell; wide ones are drawn as points (E228)
constexpr double rounding = 1.001;                    // factor of the radius of the ball that holds all paths

EchoOptions echo_options_of(const SonarHead& head, const SimulationOptions& o) {
  EchoOptions echoes;
  const bool of_power = gives_power(o.synthesis.method) || draws_cells(o);
  echoes.amplitude = of_power ? SurfaceAmplitude::mean_power : o.amplitude;
  echoes.seed = o.seed;
  echoes.threads = o.threads;
  return with_patterns(echoes, head);
}

/// The most by which a path through the profile turns on its way out to `range`: it bends by the gradient of sound
/// speed.
double most_turned(const SoundSpeedProfile& profile, double range) {
  const auto [slowest, fastest] = std::minmax_element(profile.sound_speed.begin(), profile.sound_speed.end());
  double steepest = 0;
  for (std::size_t i = 1; i < profile.depth.size(); ++i)
    steepest = std::max(steepest, std::abs(profile.sound_speed[i] - profile.sound_speed[i - 1]) /
                                      (profile.depth[i] - profile.depth[i - 1]));
  return steepest / *slowest * range * *fastest / *slowest;
}

/// How far beside their main lobes beams may receive echoes as loud as inside, in u and v: by what profile and motion
/// do, whether their stages are in or out, so that the scatterers are the same.
double lobe_margin(const SonarHead& head, const Medium& medium, const Environment& environment, const Motion& motion,
                   double fastest_part, double half_extent) {
  if (has_further_lobes(head, medium.sound_speed / head.pulse.centre_frequency)) return lobes_everywhere;
  double margin = receive_array(head)->bent_by(head.fan, half_extent);
  if (environment.profile) margin += most_turned(*environment.profile, head.gate.max_range);
  // A moving head has turned when it receives.
  if (!motion.none())
    margin += 3 * most_displacement(motion, medium.sound_speed) +
              motion.turn_rate.norm() * 2 * head.gate.max_range / medium.sound_speed;
  if (fastest_part > 0) margin += 3 * most_displacement(Motion{{fastest_part, 0, 0}, {}}, medium.sound_speed);
  return std::min(margin, lobes_everywhere);
}

SamplingOptions sampling_of(const WholeScene& scene, const ResolvedPing& ping) {
  const SonarHead& head = ping.head;
  const SimulationOptions& o = ping.options;
  const Medium& medium = ping.sent.medium;
  SamplingOptions s;
  s.kind = o.sampling.kind;
  s.scatterers_per_cell = o.sampling.scatterers_per_cell;
  s.range_resolution = range_resolution(head.pulse, medium.sound_speed);
  if (draws_cells(o)) {
    // Energies are spread over whole surfels: scatterers only carry the speckle.
    s.scatterers_per_cell = std::min(s.scatterers_per_cell, scatterers_per_display_cell);
    s.range_resolution = std::max(s.range_resolution, head.gate.bin_size);
  }
  s.rays_per_beam = o.sampling.rays_per_beam;
  const bool all_elevations = o.sampling.outer_elevations == Choice::always;
  s.elevation_half_extent = sampled_half_extent(head, all_elevations ? nothing_db : o.sampling.elevation_floor_db);
  s.azimuth_margin = o.sampling.outer_azimuths == Choice::always ? pi : o.sampling.azimuth_margin;
  s.lobe_margin =
      lobe_margin(head, medium, ping.environment, ping.event.motion, scene.fastest, s.elevation_half_extent);
  s.occlusion = o.sampling.occlusion;
  s.relief_outer_scale = scene.mean_spacing;
  s.seed = o.seed;
  s.threads = o.threads;
  return s;
}

RangeGate sampled_gate(const WholeScene& scene, const SonarHead& head, const Medium& medium, double tolerance) {
  const double widest = head.gate.max_range - head.gate.min_range;  // a larger part is of no use to a ping
  const double part = std::min(widest, std::sqrt(scene.largest_area / pi));
  const double reach = part + 0.5 * medium.sound_speed * pulse_half_length(head.pulse, 0.5 * tolerance);
  RangeGate gate = head.gate;
  gate.min_range = std::max(std::min(nearest_range, gate.min_range), gate.min_range - reach);
  gate.max_range += reach;
  return gate;
}

/// Sector of all that may be sampled: what is open counts as in.
Sector widest_sector(const ResolvedPing& ping) {
  SamplingOptions widest = ping.view.sampling;
  if (ping.options.sampling.outer_azimuths == Choice::as_needed) widest.azimuth_margin = pi;
  if (ping.options.sampling.outer_elevations == Choice::as_needed)
    widest.elevation_half_extent = sampled_half_extent(ping.head, nothing_db);
  return insonified_sector(ping.head.fan, widest);
}

/// Returns the region of the surfels that a ping may need. Effects that are open count as in.
InsonifiedRegion region_of(const ResolvedPing& ping) {
  const View& view = ping.view;
  const double legs = reach_of_legs(ping);
  if (legs == 0) return {view.world_from_head, widest_sector(ping), view.gate, view.sampling.footprint};
  // Bounces come from all sides: whatever is nearer than the longest leg may reflect or block one.
  InsonifiedRegion region = region_around(view.world_from_head.translation(), rounding * legs);
  region.footprint = view.sampling.footprint;
  return region;
}

/// Decides whether surfels are merged, and to nodes of which width.
void decide_detail(SamplingSettings& s) {
  const bool has_width = s.detail_width > 0 || s.detail_spacing > 0;
  s.detail = chosen(s.detail == Choice::always || (s.detail == Choice::as_needed && has_width));
  if (s.detail == Choice::never) s.detail_width = s.detail_spacing = 0;
  if (s.detail == Choice::always && !has_width) s.detail_width = usual_detail_width;
}

DetectionOptions detection_of(const SimulationOptions& o, const SonarHead& head, double range_resolution,
                              double beam_noise_db) {
  DetectionOptions detection = o.detection;
  if (detection.side_lobe_reach == 0) detection.side_lobe_reach = 0.5 * receive_array(head)->length();  // (E19)
  if (detection.range_resolution == 0) detection.range_resolution = range_resolution;
  detection.threads = o.threads;
  if (std::isinf(detection.noise_floor_db)) detection.noise_floor_db = beam_noise_db;
  return detection;
}

}  // namespace

bool has_further_lobes(const SonarHead& head, double wavelength) {
  return receive_array(head)->has_further_lobes(head.fan, wavelength);
}

void serve_array(const SonarHead& head, SimulationOptions& options) {
  const Engine& engine = engine_of(options.synthesis.method);
  if (engine.replaceable && options.synthesis.true_delays == Choice::as_needed) return;
  if (!engine.suits(head)) options.synthesis.method = engine.referee;
}

SamplingOptions sampling_in_view(const ResolvedPing& ping) {
  SamplingOptions s = ping.view.sampling;
  s.azimuth_margin = ping.options.sampling.azimuth_margin;
  s.elevation_half_extent = sampled_half_extent(ping.head, ping.options.sampling.elevation_floor_db);
  return s;
}

bool merges_surfels(const SceneCloud& scene, const SimulationOptions& options) {
  return options.sampling.detail == Choice::always && scene.facet.empty() && scene.parts.empty() &&
         !options.outputs.scatterers && !options.outputs.mask;
}

bool has_boundary(const Environment& environment) { return environment.surface || environment.bottom; }

bool may_mirror(const Environment& environment, bool smooth_scene) {
  return smooth_scene || environment.tank || !environment.mirrors.empty();
}

void find_smooth(const SceneCloud& scene, ResolvedPing& ping) {
  if (ping.options.effects.mirrors == Choice::never || !ping.smooth_scene) return;
  const SmoothShapes fitted = fit_shapes(scene, ping.view.world_from_head.translation(), reach_of_legs(ping));
  ping.smooth = {mirrors_of(ping.environment), fitted.targets};
  ping.smooth.mirrors.insert(ping.smooth.mirrors.end(), fitted.mirrors.begin(), fitted.mirrors.end());
}

double reach_of_legs(const ResolvedPing& ping) {
  const EffectSettings& effects = ping.options.effects;
  const bool multipath = effects.multipath != Choice::never && has_boundary(ping.environment);
  const bool mirrors = effects.mirrors != Choice::never && may_mirror(ping.environment, ping.smooth_scene);
  if (!multipath && !mirrors) return 0;
  const std::vector<Mirror> declared = mirrors_of(ping.environment);
  return longest_leg(ping.environment, mirrors ? declared : std::vector<Mirror>{}, ping.view, ping.sent);
}

void derive(const WholeScene& scene, ResolvedPing& ping) {
  ping.head.gate =
      draws_cells(ping.options) ? display_gate(ping.samples, ping.options.outputs.display_bins) : ping.samples;
  const SonarHead& head = ping.head;
  serve_array(head, ping.options);
  const SimulationOptions& options = ping.options;
  const Medium medium =
      medium_of(ping.environment, head.pulse.centre_frequency, options.effects.absorption_order.value_or(0));
  ping.sent = {head.pulse, medium, echo_options_of(head, options), std::move(ping.sent.surfaces)};
  ping.view = {ping.event.world_from_head, head.fan, sampled_gate(scene, head, medium, options.synthesis.tolerance),
               sampling_of(scene, ping)};
  ping.smooth_scene = scene.smooth;
  ping.view.sampling.inner_sector = insonified_sector(head.fan, sampling_in_view(ping));
  ping.region = region_of(ping);
  ping.detection = detection_of(options, head, ping.view.sampling.range_resolution, ping.beam_noise_db);
}

void require_valid(const SonarHead& head, const Environment& environment, const SimulationOptions& options,
                   const char* who) {
  require_valid(head, who);
  require_valid(options, who);
  if (const Engine& engine = engine_of(options.synthesis.method); !engine.replaceable && !engine.suits(head))
    fail(ErrorKind::argument, who, ": options.synthesis.method = ", engine.word, " does not form beams of a ",
         array_kinds[static_cast<std::size_t>(head.array_shape)].name,
         " array; leave the method out, or use direct, element-exact or incoherent");
  if (options.effects.multipath == Choice::always && !has_boundary(environment))
    fail(ErrorKind::argument, who, ": options.effects.multipath = always, but the environment has neither surface nor ",
         "bottom, must have one of them");
}

ResolvedPing resolve_ping(const WholeScene& scene, const SonarHead& head, const PingEvent& event,
                          const Environment& surroundings, const SimulationOptions& options, const char* who) {
  require_valid(head, surroundings, options, who);
  require_valid(event, who);
  ResolvedPing ping{head, event, environment_at(surroundings, event.world_from_head.translation().z(), who), options};
  decide_detail(ping.options.sampling);
  ping.samples = head.gate;
  ping.smooth.mirrors = mirrors_of(ping.environment);
  if (options.effects.mirrors == Choice::always && !may_mirror(ping.environment, scene.smooth))
    fail(ErrorKind::argument, who, ": options.effects.mirrors = always, but neither the environment nor a material of ",
         "the scene has mirrors: give [[mirror]], [tank], or `mirror = true` of a material");
  ping.element_noise_db = element_noise_level_db(ping.environment, head.pulse);
  ping.beam_noise_db = ping.element_noise_db - array_gain_db(head);
  derive(scene, ping);
  return ping;
}

}  // namespace insonify
