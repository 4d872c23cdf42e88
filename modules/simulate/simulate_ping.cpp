#include "simulate/simulate_ping.hpp"

#include <cmath>

#include "acoustics/reverberation_echoes.hpp"
#include "simulate/attach_outputs_internal.hpp"
#include "simulate/converge_sampling.hpp"
#include "simulate/layer_sum_internal.hpp"
#include "simulate/stage_options_internal.hpp"
#include "simulate/stop_watch_internal.hpp"

namespace insonify {

SimulatedPing simulate_ping(const PreparedScene& prepared, const SonarHead& head, const Pose& world_from_head,
                            const Environment& environment, const SimulationOptions& options) {
  require_valid(head, "simulate_ping");
  require_valid(environment, "simulate_ping");
  SimulatedPing result;
  StopWatch watch;

  // The water: how fast sound travels and how much of it is lost on the way.
  result.medium = medium_of(environment, head.pulse.centre_frequency, options.absorption_order);
  const Transmission sent{head.pulse, result.medium, echo_options_of(head, options)};

  // What the head sees: visible surface patches inside fan and range gate, where refraction makes them seem to be.
  View view = view_of(prepared.largest_area(), head, world_from_head, result.medium, options);
  Sampling sampling = options.level_error_db == 0
                          ? find_scatterers(prepared, world_from_head, view.fan, view.gate, view.sampling)
                          : converge_sampling(prepared, head, sent, options.level_error_db, view, result.convergence);
  if (environment.profile)
    result.refraction = refract(environment, view, options.refraction, head.gate.bin_size, sampling.scatterers);
  result.seconds.sampling = watch.lap();

  // What comes back: one echo per patch, with spreading, scattering, speckle and carrier phase.
  const Scatterers& seen = sampling.scatterers;
  Echoes echoes = direct_echoes(seen, prepared.scene().materials, sent.pulse, sent.medium, sent.echo_options);
  if (!options.motion.none())
    move_echoes(options.motion, world_from_head, seen, sent.pulse.centre_frequency, sent.medium.sound_speed, echoes);
  result.seconds.acoustics = watch.lap();

  // What the array makes of it: a complex time series per beam, and of all else there is to hear.
  LayerSum layers(head, result.medium, options);
  layers.add("direct", echoes);
  Multipath bounced;
  if (options.multipath) bounced = multipath_echoes(prepared.scene(), seen, environment, view, sent);
  if (options.multipath) layers.add("multipath", bounced.echoes);
  for (const Reverberation& part : reverberation_echoes(environment, view, sent, options.ping))
    layers.add(part.name, part.echoes);
  if (options.noise) layers.add_noise(environment);
  layers.finish(world_from_head, result);
  result.seconds.synthesis = watch.lap();

  // What an operator would mark: detections, as points in the world.
  const DetectionOptions detection = detection_options(head, environment, options);
  result.noise_floor_db = detection.noise_floor_db;
  result.soundings = detect_soundings(result.ping, seen, echoes, detection);
  result.seconds.detection = watch.lap();

  // What else was asked for, and what to know about it.
  result.sampling = sampling.report;
  result.scatterers = std::move(sampling.scatterers);
  attach_outputs(prepared, head, {view, environment, echoes, bounced}, options, result);
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
