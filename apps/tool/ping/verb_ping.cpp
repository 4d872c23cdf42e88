// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/stop_watch.hpp"
#include "core/units.hpp"
#include "scene_io/save_cloud.hpp"
#include "simulate/ping_simulator.hpp"
#include "store/element_file.hpp"
#include "tool/command/run_settings.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "tool/ping/ping_report.hpp"
#include "tool/run/ping_setup.hpp"
#include "tool/run/run_checks.hpp"
#include "tool/run/run_files.hpp"
#include "tool/run/scene_files.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

std::string summary(const std::string& output, const ordered_json& manifest) {
  return fmt::format("{}: {} scatterers of {} visible surfels, {} soundings, peak {:.1f} dB re 1 uPa", output,
                     manifest["sampling"]["scatterers"].get<std::size_t>(),
                     manifest["sampling"]["visible"].get<std::size_t>(),
                     manifest["sampling"]["soundings"].get<std::size_t>(), manifest["peak_level_db"].get<double>());
}

void add_ping_verb_options(OptionList list, PingCommand& command) { add_ping_options(list, command, true); }

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

void ping(const PingCommand& command) {
  PingOptions o = complete_options(command);
  const CommonOptions& common = o.common;
  // The whole command line is checked before any work.
  Progress progress(common, 4);
  PingSetup ready = set_up_ping(o);
  const HeadSetup& setup = ready.head;
  const SimulationOptions& simulation = ready.simulation;
  InputPaths inputs = input_files(all_settings(o));
  inputs.insert(inputs.end(), {o.run.sonar, o.run.environment, o.run.profile});
  RunDirectory directory(o.run.output, o.run.force, inputs);

  progress.step("loading " + o.scene.path);
  StopWatch watch;
  const PingScene in_reach = load_ping_scene(o, ready);
  const LoadedScene& loaded = in_reach.loaded;
  const double load_seconds = watch.lap();
  ordered_json manifest = {{"schema", 1},
                           {"insonify_version", INSONIFY_VERSION},
                           {"seed", common.seed},
                           {"scene", in_reach.json},
                           {"notes", ordered_json::array()}};
  const auto note_to_user = [&](const std::string& note) {
    progress.note(note);
    manifest["notes"].push_back(note);
  };
  for (const std::string& note : setup.notes) note_to_user(note);
  for (const std::string& note : loading_notes(loaded.report)) note_to_user(note);

  const PreparedScene scene(loaded.scene, simulation.threads);
  PingPlan plan = ready.simulator().plan(scene, ready.event);
  manifest["plan"] = plan_json(plan);

  progress.step("pinging");
  ContributorWriter contributors(directory, loaded.scene, setup.head, plan.options.outputs);
  SimulatedPing result = PingSimulator(setup.head, setup.environment, plan.options).ping(scene, ready.event);
  for (const std::string& note : ping_notes(result, ready, in_reach.places, !o.mount.empty())) note_to_user(note);

  progress.step("writing " + o.run.output);
  watch.lap();
  const Eigen::Vector3d origin = save_returns(directory, result.soundings, manifest);
  if (!origin.isZero(0)) note_to_user(origin_note(origin));
  if (simulation.outputs.elements)
    write_element_file(directory.file("elements.h5"), result.outputs.elements, setup.head,
                       result.report.medium.sound_speed);
  contributors.finish(result.ping.labels, o.scene.path, manifest);
  write_kept(directory, o, loaded.scene, ready, result, manifest);
  describe(result, simulation, ready.event.motion, manifest);
  write_run(directory, common, o.run, setup, std::move(result.ping), settings_as_toml(all_settings(o)), manifest,
            progress);
  manifest["seconds"] = seconds_json(load_seconds, result.report.seconds, watch.lap());
  write_manifest(directory, manifest);
  progress.step("done");
  directory.commit();
  print_summary(common, manifest, summary(o.run.output, manifest));
}

}  // namespace

Verb ping_verb() {
  return make_verb<PingCommand>(
      "ping", "what the sonar hears of the scene: the main job",
      {"insonify ping reef.pcd --sonar oculus-m750d --pose=-1,4,-2.2,0,15,0 --range 0.5:9 -o out",
       "insonify ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 --set water.temperature_c=4 -o cold",
       "insonify ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,0,0 --multipath --set surface.height_m=0 --layers "
       "-o sea",
       "insonify ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 --noise --set wind.speed_m_s=8 "
       "--profile ctd.csv --set surface.height_m=0 -o gale",
       "insonify ping --run out/run.toml -o again"},
      add_ping_verb_options, ping);
}

}  // namespace insonify::tool
