// SPDX-License-Identifier: BSD-3-Clause
#include "run_scenes/ping_run.hpp"

#include "core/error.hpp"
#include "run/scene_reach.hpp"
#include "run_scenes/parts_of_pings.hpp"

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
  if (draw > 0 && (!parts || parts->scene().file().scatters.empty()))
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
  if (file || (parts && !parts->scene().has_tiles()))
    require_in_reach(ready.scene.positions, setup.head.gate, run.scene.path);
  return ready;
}

}  // namespace insonify
