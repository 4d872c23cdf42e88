#include "simulate/simulate_ping.hpp"

#include <chrono>
#include <cmath>

#include "acoustics/noise.hpp"
#include "beamforming/synthesize_noise.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

/// Elevations at which the pattern is down by more than this are not sampled.
constexpr double elevation_floor_db = -40;

/// Seconds since the last call.
class StopWatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> seconds = now - last_;
    last_ = now;
    return seconds.count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

SamplingOptions sampling_options(const SonarHead& head, const Medium& medium, const SimulationOptions& o) {
  SamplingOptions s;
  s.kind = o.sampling;
  s.scatterers_per_cell = o.scatterers_per_cell;
  s.range_resolution = range_resolution(head.pulse, medium.sound_speed);
  s.rays_per_beam = o.rays_per_beam;
  s.elevation_half_extent = elevation_half_extent(head.elevation_shape, head.fan.elevation_width, elevation_floor_db);
  s.occlusion = o.occlusion;
  s.seed = o.seed;
  s.threads = o.threads;
  return s;
}

HearingOptions hearing_options(const SonarHead& head, const SimulationOptions& o) {
  return {o.amplitude, head.elevation_shape, head.fan.elevation_width, head.fan.elevation[0], o.seed, o.threads};
}

DetectionOptions detection_options(const SonarHead& head, const Medium& medium, const SimulationOptions& o) {
  DetectionOptions d = o.detection;
  d.threads = o.threads;
  if (std::isinf(d.noise_floor_db))
    d.noise_floor_db = thermal_noise_level_db(head.pulse) -
                       directivity_index_db(head.array, medium.sound_speed / head.pulse.centre_frequency);
  return d;
}

}  // namespace

SimulatedPing simulate_ping(const SceneCloud& scene, const SonarHead& head, const Pose& world_from_head,
                            const Water& water, const SimulationOptions& options) {
  require_valid(head, "simulate_ping");
  SimulatedPing result;
  StopWatch watch;

  // The water: how fast sound travels and how much of it is lost on the way.
  result.medium = medium_of(water, head.pulse.centre_frequency, options.absorption_order);

  // What the head sees: visible surface patches inside fan and range gate.
  Sampling sampling =
      find_scatterers(scene, world_from_head, head.fan, head.gate, sampling_options(head, result.medium, options));
  result.seconds.sampling = watch.lap();

  // What comes back: one echo per patch, with spreading, scattering, speckle and carrier phase.
  const Echoes echoes =
      hear_scatterers(sampling.scatterers, scene.materials, head.pulse, result.medium, hearing_options(head, options));
  result.seconds.acoustics = watch.lap();

  // What the array makes of it: a complex time series per beam.
  const auto synthesize = options.method == SynthesisMethod::direct ? synthesize_direct : synthesize_stamped;
  ComplexGrid pressure = synthesize(echoes, head, result.medium, {options.tolerance, options.threads});
  if (options.noise)
    pressure +=
        synthesize_noise(head, result.medium, thermal_noise_level_db(head.pulse), {options.seed, 0, options.threads});
  result.ping = {0, 0, world_from_head, head.fan, head.gate, stored_pressure(pressure, "simulate_ping")};
  result.seconds.synthesis = watch.lap();

  // What an operator would mark: detections, as points in the world.
  const DetectionOptions detection = detection_options(head, result.medium, options);
  result.noise_floor_db = detection.noise_floor_db;
  result.soundings = detect_soundings(result.ping, sampling.scatterers, echoes, detection);
  result.seconds.detection = watch.lap();

  result.sampling = sampling.report;
  result.scatterers = std::move(sampling.scatterers);
  return result;
}

}  // namespace insonify
