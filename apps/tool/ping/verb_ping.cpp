// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "run_scenes/run_folder.hpp"
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
  Progress progress(command.common, 4);
  const PingSetup setup = set_up_ping(complete_run(command));  // checks the whole command line before any work
  const ordered_json manifest = make_ping_run(setup, VtkPictures(), progress);
  print_summary(command.common, manifest, summary(setup.run.output.folder, manifest));
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
