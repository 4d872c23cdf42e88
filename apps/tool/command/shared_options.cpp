// SPDX-License-Identifier: BSD-3-Clause
#include "tool/command/shared_options.hpp"

#include <fmt/format.h>

#include "run/ping_setup.hpp"
#include "run/run_settings.hpp"
#include "scene_io/load_scene.hpp"
#include "store/sonar_file.hpp"

namespace insonify::tool {

void add_verbosity(OptionList list, CommonOptions& o) {
  list.add("-q,--quiet", &o.quiet, "print no notes and no summary");
  list.add("-v,--verbose", &o.verbose, "print each step");
}

void add_common(OptionList list, CommonOptions& o) {
  add_verbosity(list, o);
  list.add("--json", &o.json, "print the result as JSON on stdout");
}

void add_work(OptionList list, CommonOptions& o) {
  list.add("-j,--threads", &o.threads, "number of threads; 0: all cores. Results do not depend on it",
           {.within = std::pair(0, 1024)});
  add_settings(list, {seed_setting(o)});
}

void add_settings(OptionList list, const std::vector<RunSetting>& settings) {
  for (const RunSetting& s : settings) list.add(s.option, s.value, s.help, s.rules);
}

void add_scene(OptionList list, SceneOptions& o) {
  std::vector<RunSetting> settings = scene_settings(o);
  settings.front().help += ": " + scene_extensions() + " .toml";
  add_settings(list, settings);
}

void add_completion(OptionList list, SceneOptions& o) {
  const auto settings = scene_settings(o);
  add_settings(list, {settings.begin() + 1, settings.end()});
}

void add_sonar(OptionList list, CommonOptions& common, RunOptions& o, const char* default_range) {
  list.add("--sonar", &o.sonar, "preset (see `insonify sonars`), a .toml file, or the run.toml of a run",
           {.required = true, .group = sonar_title});
  list.add("--range", &o.range, fmt::format("min:max [m]; default: {}", default_range), {.group = sonar_title});
  list.add("--environment", &o.environment,
           "TOML file: [water] [surface] [bottom] [volume] [wind] [noise] [profile], or the run.toml of a run",
           {.group = sonar_title});
  list.add("--profile", &o.profile,
           "CSV depth_m,sound_speed (or depth_m,temperature_c,salinity_psu) of a profile that bends rays; needs "
           "surface.height_m or water.level_m",
           {.group = sonar_title});
  list.add("--set", &common.settings,
           "SECTION.KEY=VALUE that replaces a value of sonar or environment, e.g. water.temperature_c=4",
           {.one_each = true, .group = sonar_title});
  add_settings(list, synthesis_settings(o));
}

void add_output(OptionList list, RunOptions& o) {
  list.add("-o,--output", &o.output, "run directory that is made", {.required = true, .group = output_title});
  list.add("--force", &o.force, "replace an existing run directory", {.group = output_title});
  list.add("--no-picture", &o.no_picture, "do not draw fan.png", {.group = output_title});
}

void add_world(OptionList list, std::string& world) {
  list.add("--world", &world, "axes of --pose: z-up, or ned (z down, pitch positive nose up)",
           {.words = {"z-up", "ned"}});
}

void add_ping_options(OptionList list, PingCommand& command, bool with_output) {
  // Values are written in the order of the options, so --run comes first and all others override it.
  const auto load_run = [list, &command](const std::string& path) mutable {
    command.options = command.of_run.emplace(load_ping_settings(path));
    require_valid_file(path, command.options);
    list.release("SCENE");
    list.release("--sonar");
  };
  list.add("--run", load_run,
           "run.toml of an earlier ping, whose scene, sonar and options are taken unless others are given; "
           "--noise=false switches a flag off");
  PingOptions& o = command.options;
  add_scene(list, o.scene);
  add_sonar(list, o.common, o.run,
            "from the sonar's least range to the end of the scene, at most to the sonar's greatest range");
  // Titles stand in the order in which they are first used.
  if (with_output) add_output(list, o.run);
  add_settings(list, ping_settings(o));
  add_common(list, o.common);
  add_work(list, o.common);
}

PingOptions complete_options(const PingCommand& command) {
  PingOptions o = command.options;
  // A run records its mounting, since its own file of the sonar does not hold it.
  const bool other_sonar = !command.of_run || o.run.sonar != command.of_run->run.sonar;
  if (o.mount.empty() && other_sonar) o.mount = mounting_text(find_sonar(o.run.sonar));
  if (!command.of_run) return o;
  const PingOptions &run = *command.of_run, defaults;
  const bool new_pose = o.pose != run.pose, new_trajectory = o.trajectory != run.trajectory;
  if (new_pose && !new_trajectory) o.trajectory.clear();
  if (!new_trajectory || new_pose) return o;
  // A trajectory says all that a pose and its motion say.
  o.pose.clear();
  if (o.world == run.world) o.world = defaults.world;
  if (o.velocity == run.velocity) o.velocity.clear();
  if (o.turn_rate == run.turn_rate) o.turn_rate.clear();
  return o;
}

}  // namespace insonify::tool
