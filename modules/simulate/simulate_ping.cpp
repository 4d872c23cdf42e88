#include "simulate/simulate_ping.hpp"

#include <cmath>

#include "acoustics/hear_reverberation.hpp"
#include "simulate/layer_sum.hpp"
#include "simulate/stage_options.hpp"
#include "simulate/stop_watch.hpp"

namespace insonify {

SimulatedPing simulate_ping(const PreparedScene& prepared, const SonarHead& head, const Pose& world_from_head,
                            const Environment& environment, const SimulationOptions& options) {
  require_valid(head, "simulate_ping");
  require_valid(environment, "simulate_ping");
  const SceneCloud& scene = prepared.scene();
  SimulatedPing result;
  StopWatch watch;

  // The water: how fast sound travels and how much of it is lost on the way.
  result.medium = medium_of(environment, head.pulse.centre_frequency, options.absorption_order);

  // What the head sees: visible surface patches inside fan and range gate, where refraction makes them seem to be.
  const View view = view_of(largest_area(prepared), head, world_from_head, result.medium, options);
  Sampling sampling = find_scatterers(prepared, world_from_head, view.fan, view.gate, view.sampling);
  if (environment.profile)
    result.refraction = refract(environment, view, options.refraction, head.gate.bin_size, sampling.scatterers);
  result.seconds.sampling = watch.lap();

  // What comes back: one echo per patch, with spreading, scattering, speckle and carrier phase.
  const Transmission sent{head.pulse, result.medium, hearing_options(head, options)};
  Echoes echoes = hear_scatterers(sampling.scatterers, scene.materials, sent.pulse, sent.medium, sent.hearing);
  if (!options.motion.none())
    move_echoes(options.motion, world_from_head, sampling.scatterers, sent.pulse.centre_frequency,
                sent.medium.sound_speed, echoes);
  result.seconds.acoustics = watch.lap();

  // What the array makes of it: a complex time series per beam, and of all else there is to hear.
  LayerSum layers(head, result.medium, options);
  layers.add("direct", echoes);
  if (options.multipath)
    layers.add("multipath", hear_multipath(scene, sampling.scatterers, environment, view, sent).echoes);
  for (const Reverberation& part : hear_reverberation(environment, view, sent, options.ping))
    layers.add(part.name, part.echoes);
  if (options.noise) layers.add_noise(environment);
  layers.hand_over(world_from_head, result);
  result.seconds.synthesis = watch.lap();

  // What an operator would mark: detections, as points in the world.
  const DetectionOptions detection = detection_options(head, environment, options);
  result.noise_floor_db = detection.noise_floor_db;
  result.soundings = detect_soundings(result.ping, sampling.scatterers, echoes, detection);
  result.seconds.detection = watch.lap();

  result.sampling = sampling.report;
  if (options.sampling == SamplingKind::rays) result.notes = gap_notes(scene, view, sampling.scatterers);
  result.scatterers = std::move(sampling.scatterers);
  return result;
}

SimulatedPing simulate_ping(const SceneCloud& scene, const SonarHead& head, const Pose& world_from_head,
                            const Environment& environment, const SimulationOptions& options) {
  StopWatch watch;
  const PreparedScene prepared(scene, options.threads);
  const double seconds = watch.lap();
  SimulatedPing result = simulate_ping(prepared, head, world_from_head, environment, options);
  result.seconds.sampling += seconds;
  return result;
}

}  // namespace insonify
