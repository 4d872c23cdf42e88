// SPDX-License-Identifier: BSD-3-Clause
#include "core/error.hpp"
#include "core/stop_watch.hpp"
#include "run/run_settings.hpp"
#include "run/scene_reach.hpp"
#include "run_scenes/parts_of_pings.hpp"
#include "run_scenes/run_folder.hpp"

namespace insonify {
namespace {

/// Decides whether a ping merges surfels of tiles: if so many are within its reach that reading them takes longer than
/// the decision.
void decide_detail(const OpenScene& scene, PingSetup& setup) {
  constexpr std::size_t many = std::size_t{1} << 22;
  const TiledScene* const tiled = scene.tiles();
  if (!tiled) return;
  const PingSimulator simulator = setup.simulator();
  if (tiled->select(simulator.reach(tiled->info().whole, setup.event)).surfels < many) return;
  Choice& detail = setup.simulation.sampling.detail;
  const Choice requested = detail;
  detail = simulator.for_many(1, scene, setup.event).options().sampling.detail;
  record_detail(requested, detail, setup.run);
}

}  // namespace

ReadyPing load_ping_scene(PingSetup& setup) {
  const Run& run = setup.run;
  const int draw = run.placement.draw;
  const RunDraws draws{run.simulation.seed, {0, static_cast<std::uint64_t>(draw)}};
  const auto scene = open_scene(run.scene, {draws, run.simulation.threads, run.memory_limit});
  const PartsOfPings* parts = scene->parts();
  if (draw > 0 && (!parts || parts->file().scatters.empty()))
    fail(ErrorKind::argument, "--draw = ", draw, ": ", run.scene.path,
         parts ? " has no [[scatter]] to draw" : " is no scene of parts", "; leave it out");
  const PingEvent& event = setup.event;
  const Bounds box = scene->box_at(scene->moment_of(event.time, event.number));
  end_range_with_scene(setup, box, event.world_from_head);
  decide_detail(*scene, setup);
  const PingSimulator simulator = setup.simulator();
  ReadyPing ready{scene->ping_scene(simulator, event), simulator};
  const LoadedScene* file = scene->loaded();
  const SceneCloud& known = file ? file->scene : ready.scene.scene->scene();
  for (std::string& note : fit_notes(known, box, setup)) setup.notes.push_back(std::move(note));
  if (file || (parts && !parts->has_tiles())) require_in_reach(ready.scene.positions, setup.head.gate, run.scene.path);
  return ready;
}

nlohmann::ordered_json make_ping_run(PingSetup setup, const RunPictures& pictures, RunObserver& observer) {
  std::vector<std::string> inputs = input_files(all_settings(setup.run));
  const Run& run = setup.run;
  inputs.insert(inputs.end(), {run.head.sonar, run.head.environment, run.head.profile});
  RunFolder folder(setup, inputs, pictures, observer);

  observer.step("loading " + run.scene.path);
  StopWatch watch;
  const ReadyPing sent = load_ping_scene(setup);
  const double load_seconds = watch.lap();
  const PreparedScene& scene = *sent.scene.scene;
  for (const std::string& note : notes_before(setup, sent.scene.report)) observer.note(note);
  const SimulationOptions options = folder.options_for(scene.scene());
  SceneInstances instances;
  if (options.outputs.contributors > 0 || options.outputs.labels) instances = instances_of_scene(run.scene.path);

  observer.step("pinging");
  PingPlan plan;
  SimulatedPing made = sent.simulator.with(options).ping(scene, setup.event, plan);
  nlohmann::ordered_json manifest = folder.write(std::move(made), plan, sent.scene, instances, load_seconds);
  observer.step("done");
  folder.commit();
  return manifest;
}

}  // namespace insonify
