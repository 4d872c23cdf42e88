#include "simulate/simulate_ping.hpp"

#include <utility>

#include "core/stop_watch.hpp"
#include "core/work_progress.hpp"
#include "simulate/average_looks_internal.hpp"
#include "simulate/layer_sum_internal.hpp"
#include "simulate/ping_stages_internal.hpp"
#include "simulate/plan_stages_internal.hpp"

namespace insonify {

SimulatedPing simulate_ping(const PreparedScene& prepared, const SonarHead& head, const Pose& world_from_head,
                            const Environment& environment, const SimulationOptions& options, KeptSynthesizers* kept) {
  const SceneCloud& scene = prepared.scene();
  SimulatedPing result;
  StopWatch watch;

  // What is computed: as the options say, and where they leave it open as the accuracy asks for.
  const SimulationOptions settled =
      settled_options(prepared, head, world_from_head, environment, options, "simulate_ping");
  ResolvedPing ping = resolve_ping(prepared.whole(), head, world_from_head, environment, settled, "simulate_ping");
  const EffectSettings& effects = settled.effects;

  // What the head sees: visible surface patches inside fan and range gate, where refraction makes them seem to be.
  begin_stage("sampling");
  PingParts parts = sample_parts(prepared, ping, result);
  result.seconds.sampling = watch.lap();

  // What comes back: one echo per patch, with spreading, scattering, speckle and carrier phase; stored or made when used.
  begin_stage("echoes");
  const EchoSource direct = direct_source(scene, ping, parts);
  result.seconds.acoustics = watch.lap();

  // What the array receives: a complex time series per beam, of these echoes and of all others, and noise.
  begin_stage("synthesis");
  LayerSum layers(ping, kept);
  layers.add("direct", direct);
  const bool bounces = effects.multipath == Choice::always;
  if (bounces) parts.bounced = bounced_echoes(prepared, ping, parts);
  if (bounces) layers.add("multipath", parts.bounced.echoes);
  for (const Reverberation& part : reverberation_echoes(ping)) layers.add(part.name, part.echoes);
  if (effects.noise) layers.add_noise();
  layers.finish(result);
  average_looks(prepared, ping, result);
  result.seconds.synthesis = watch.lap();

  // What an operator would mark: detections, as points in the world.
  begin_stage("detection");
  result.soundings = detect_soundings(result.ping, direct, ping.detection);
  result.seconds.detection = watch.lap();

  // What the options ask for besides, and how the ping came about.
  begin_stage("outputs");
  attach_outputs(prepared, ping, std::move(parts), result);
  return result;
}

SimulatedPing simulate_ping(const SceneCloud& scene, const SonarHead& head, const Pose& world_from_head,
                            const Environment& environment, const SimulationOptions& options, KeptSynthesizers* kept) {
  require_valid(options, "simulate_ping");
  StopWatch watch;
  const PreparedScene prepared(scene, options.threads);
  const double seconds = watch.lap();
  SimulatedPing result = simulate_ping(prepared, head, world_from_head, environment, options, kept);
  result.seconds.sampling += seconds;
  return result;
}

}  // namespace insonify
