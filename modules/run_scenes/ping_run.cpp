// SPDX-License-Identifier: BSD-3-Clause
#include "run_scenes/ping_run.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/stop_watch.hpp"
#include "core/units.hpp"
#include "run/run_checks.hpp"
#include "run/run_settings.hpp"
#include "run/scene_reach.hpp"
#include "run_scenes/parts_of_pings.hpp"
#include "run_scenes/ping_report.hpp"
#include "scene_io/save_cloud.hpp"
#include "simulate/ping_notes.hpp"
#include "store/element_file.hpp"

namespace insonify {
namespace {

using nlohmann::ordered_json;

double peak_level_db(const Ping& ping) {
  const auto power = [](const std::complex<float>& p) { return std::norm(std::complex<double>(p)); };
  return std::max(silence_db, pressure_level_db(std::sqrt(ping.pressure.unaryExpr(power).maxCoeff())));
}

/// Writes the returns as both clouds; returns the local origin of the PCD.
Eigen::Vector3d save_returns(RunDirectory& directory, const Soundings& soundings, ordered_json& manifest) {
  const Eigen::Vector3d origin = save_soundings(directory.file("returns.pcd"), soundings);
  manifest["returns_pcd_origin_m"] = {origin.x(), origin.y(), origin.z()};
  save_soundings(directory.file("returns.ply"), soundings);
  return origin;
}

std::string origin_note(const Eigen::Vector3d& origin) {
  return fmt::format("returns.pcd counts from {:.0f}, {:.0f}, {:.0f} m, as its VIEWPOINT says: a PCD is float32",
                     origin.x(), origin.y(), origin.z());
}

/// Adds what the ping was made of to the manifest.
void describe(const SimulatedPing& result, const SimulationOptions& simulation, const Motion& motion,
              ordered_json& manifest) {
  manifest["sampling"] = sampling_json(result);
  if (simulation.outputs.mask) manifest["holes"] = holes_json(result.report.holes);
  manifest["layers"] = layers_json(result.report.layers);
  if (!motion.none()) manifest["motion"] = motion_json(motion);
  manifest["peak_level_db"] = peak_level_db(result.ping);
}

ordered_json seconds_json(double load, const StageSeconds& of, double output) {
  return {{"load", load},
          {"sampling", of.sampling},
          {"acoustics", of.acoustics},
          {"synthesis", of.synthesis},
          {"detection", of.detection},
          {"contributors", of.contributors},
          {"output", output}};
}

/// Decides whether a ping merges surfels of tiles: if so many are within its reach that reading them takes longer than
/// the decision.
void decide_detail(const OpenScene& scene, PingSetup& setup) {
  constexpr std::size_t many = std::size_t{1} << 22;
  const TiledScene* const tiled = scene.tiles();
  if (!tiled) return;
  const PingSimulator simulator = setup.simulator();
  if (tiled->select(simulator.reach(tiled->info().whole, setup.event)).surfels < many) return;
  setup.simulation.sampling.detail = simulator.for_many(1, scene, setup.event).options().sampling.detail;
}

}  // namespace

ReadyPing load_ping_scene(const PingOptions& o, PingSetup& setup) {
  const RunDraws draws{o.common.seed, {0, static_cast<std::uint64_t>(o.draw)}};
  const auto scene = open_scene(o.scene, {draws, o.common.threads, o.memory_limit});
  const PartsOfPings* parts = scene->parts();
  if (o.draw > 0 && (!parts || parts->scene().file().scatters.empty()))
    fail(ErrorKind::argument, "--draw = ", o.draw, ": ", o.scene.path,
         parts ? " has no [[scatter]] to draw" : " is no scene of parts", "; leave it out");
  const PingEvent& event = setup.event;
  const Bounds box = scene->box_at(scene->moment_of(event.time, event.number));
  end_range_with_scene(setup.head, box, event.world_from_head);
  decide_detail(*scene, setup);
  const PingSimulator simulator = setup.simulator();
  ReadyPing ready{scene->ping_scene(simulator, event), simulator};
  const LoadedScene* file = scene->loaded();
  const SceneCloud& known = file ? file->scene : ready.scene.scene->scene();
  for (std::string& note : fit_notes(known, box, setup)) setup.head.notes.push_back(std::move(note));
  if (file || (parts && !parts->scene().has_tiles()))
    require_in_reach(ready.scene.places, setup.head.head.gate, o.scene.path);
  return ready;
}

ordered_json write_ping_run(RunDirectory& directory, const PingRun& run, SimulatedPing ping,
                            ContributorWriter& contributors, const RunPictures& pictures, RunObserver& observer) {
  const PingOptions& o = run.options;
  const PingSetup& setup = run.setup;
  ordered_json manifest = {{"schema", 1},           {"insonify_version", INSONIFY_VERSION},
                           {"seed", o.common.seed}, {"scene", run.scene_json},
                           {"notes", run.notes},    {"plan", plan_json(run.plan)}};
  const auto note_to_user = [&](const std::string& note) {
    observer.note(note);
    manifest["notes"].push_back(note);
  };
  for (const std::string& note : ping_notes(ping, setup, run.places, !o.mount.empty())) note_to_user(note);

  observer.step("writing " + o.run.output);
  StopWatch watch;
  const Eigen::Vector3d origin = save_returns(directory, ping.soundings, manifest);
  if (!origin.isZero(0)) note_to_user(origin_note(origin));
  if (setup.simulation.outputs.elements)
    write_element_file(directory.file("elements.h5"), ping.outputs.elements, setup.head.head,
                       ping.report.medium.sound_speed);
  contributors.finish(ping.ping.labels, run.instances, manifest);
  write_kept(directory, o, run.scene, setup, ping, pictures, manifest);
  describe(ping, setup.simulation, setup.event.motion, manifest);
  PingOptions written = o;
  std::vector<PingNote> notes = notes_of(ping, setup.head.environment, setup.head.head.gate);
  write_run(directory, o.common, o.run, setup.head, {std::move(ping.ping), std::move(notes)},
            settings_as_toml(all_settings(written)), manifest, pictures, observer);
  manifest["seconds"] = seconds_json(run.load_seconds, ping.report.seconds, watch.lap());
  write_manifest(directory, manifest);
  return manifest;
}

void save_ping_run(const PingOptions& o, PingSetup setup, const PingInMemory& of, const RunPictures& pictures) {
  RunDirectory directory(o.run.output, o.run.force, {o.scene.path, o.run.sonar});
  std::vector<std::string>& notes = setup.head.notes;
  for (std::string& note : fit_notes(of.whole, of.box ? *of.box : bounds(of.whole), setup))
    notes.push_back(std::move(note));
  const SceneCloud& scene = of.pinged.scene();
  PingRun run{o, setup, scene, scene_json(of.report, scene), sampled_places(of.whole, setup.event.world_from_head)};
  if (!of.parts.is_null()) run.scene_json["parts"] = of.parts;
  run.plan = of.simulator.plan(of.pinged, setup.event);
  run.instances = of.instances;
  run.notes = notes;
  for (std::string& note : loading_notes(of.report)) run.notes.push_back(std::move(note));

  RunObserver silent;
  SimulationOptions options = setup.simulation;
  ContributorWriter contributors(directory, scene, setup.head.head, options);
  if (options.outputs.contributor_sink) contributors.take(of.ping.outputs.contributors, 0);
  write_ping_run(directory, run, of.ping, contributors, pictures, silent);
  directory.commit();
}

}  // namespace insonify
