// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/stop_watch.hpp"
#include "run/run_settings.hpp"
#include "run_scenes/ping_report.hpp"
#include "run_scenes/ping_run.hpp"
#include "run_scenes/run_folder.hpp"
#include "simulate/ping_simulator.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "tool/run/vtk_pictures.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

std::string summary(const std::string& output, const ordered_json& manifest) {
  return fmt::format("{}: {} scatterers of {} visible surfels, {} returns, peak {:.1f} dB re 1 uPa", output,
                     manifest["sampling"]["scatterers"].get<std::size_t>(),
                     manifest["sampling"]["visible"].get<std::size_t>(),
                     manifest["sampling"]["returns"].get<std::size_t>(), manifest["peak_level_db"].get<double>());
}

void add_ping_verb_options(OptionList list, PingCommand& command) { add_ping_options(list, command, true); }

void ping(const PingCommand& command) {
  const CommonOptions& common = command.common;
  // The whole command line is checked before any work.
  Progress progress(common, 4);
  PingSetup ready = set_up_ping(complete_run(command));
  Run& o = ready.run;
  InputPaths inputs = input_files(all_settings(o));
  inputs.insert(inputs.end(), {o.head.sonar, o.head.environment, o.head.profile});
  const VtkPictures pictures;
  RunFolder folder(ready, inputs, pictures, progress);

  progress.step("loading " + o.scene.path);
  StopWatch watch;
  const ReadyPing sent = load_ping_scene(ready);
  const double load_seconds = watch.lap();
  const PreparedScene& scene = *sent.scene.scene;
  for (const std::string& note : notes_before(ready, sent.scene.report)) progress.note(note);
  SimulationOptions options = folder.options_for(scene.scene());
  SceneInstances instances;
  if (options.outputs.contributors > 0 || options.outputs.labels) instances = instances_of_scene(o.scene.path);

  progress.step("pinging");
  PingPlan plan;
  SimulatedPing result = sent.simulator.with(options).ping(scene, ready.event, plan);
  const ordered_json manifest = folder.write(std::move(result), plan, sent.scene, instances, load_seconds);
  progress.step("done");
  folder.commit();
  print_summary(common, manifest, summary(o.output.folder, manifest));
}

}  // namespace

Verb ping_verb() {
  return make_verb<PingCommand>(
      "ping", "what the sonar hears of the scene: the main job",
      {"insonify ping reef.pcd --sonar oculus-m750d --pose=-1,4,-2.2,0,15,0 --range 0.5:9 -o out",
       "insonify ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 --set water.temperature_c=4 -o cold",
       "insonify ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,0,0 --multipath --set surface.height_m=0 --layers -o "
       "sea",
       "insonify ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 --noise --set wind.speed_m_s=8 --profile "
       "ctd.csv --set surface.height_m=0 -o gale",
       "insonify ping --run out/run.toml -o again"},
      add_ping_verb_options, ping);
}

}  // namespace insonify::tool
