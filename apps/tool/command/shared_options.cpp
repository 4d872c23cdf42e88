// SPDX-License-Identifier: BSD-3-Clause
#include "tool/command/shared_options.hpp"

#include <fmt/format.h>

#include "run/parse_values.hpp"
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

void add_work(OptionList list, int& threads, std::uint64_t& seed) {
  list.add("-j,--threads", &threads, "number of threads; 0: all cores. Results do not depend on it",
           {.within = std::pair(0, 1024)});
  add_settings(list, {seed_setting(seed)});
}

void add_settings(OptionList list, const std::vector<RunSetting>& settings) {
  for (const RunSetting& s : settings) list.add(s.option, s.value, s.help, s.rules);
}

void add_scene(OptionList list, SceneOptions& o) {
  std::vector<RunSetting> settings = scene_settings(o);
  const std::string extensions = scene_extensions() + " .toml";
  settings.front().help += ": " + extensions;
  add_settings(list, settings);
  list.complete_with("SCENE", extensions);
}

void add_completion(OptionList list, SceneOptions& o) {
  const auto settings = scene_settings(o);
  add_settings(list, {settings.begin() + 1, settings.end()});
}

OptionValue range_value(HeadOptions& o) {
  return [&o](const std::string& text) { o.range = parse_range(text); };
}

void add_sonar(OptionList list, Run& run, const char* default_range) {
  HeadOptions& o = run.head;
  list.add("--sonar", &o.sonar, "preset (see `insonify sonars`), a .toml file, or the run.toml of a run",
           {.required = true, .group = sonar_title});
  list.add("--range", range_value(o), fmt::format("min:max [m]; default: {}", default_range), {.group = sonar_title});
  list.add("--environment", &o.environment,
           "TOML file: [water] [surface] [bottom] [volume] [wind] [noise] [profile], or the run.toml of a run",
           {.group = sonar_title});
  list.add("--profile", &o.profile,
           "CSV depth_m,sound_speed (or depth_m,temperature_c,salinity_psu) of a profile that bends rays; needs "
           "surface.height_m or water.level_m",
           {.group = sonar_title});
  list.add("--set", &o.settings,
           "SECTION.KEY=VALUE that replaces a value of sonar or environment, e.g. water.temperature_c=4",
           {.one_each = true, .group = sonar_title});
  add_settings(list, synthesis_settings(run.simulation.synthesis));
}

void add_output(OptionList list, OutputOptions& o) {
  list.add("-o,--output", &o.folder, "run directory that is made", {.required = true, .group = output_title});
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
    command.run = command.of_run.emplace(load_ping_settings(path));
    require_valid_file(path, command.run);
    list.release("SCENE");
    list.release("--sonar");
  };
  list.add("--run", load_run,
           "run.toml of an earlier ping, whose scene, sonar and options are taken unless others are given; "
           "--noise=false switches a flag off");
  Run& o = command.run;
  add_scene(list, o.scene);
  add_sonar(list, o, "from the sonar's least range to the end of the scene, at most to the sonar's greatest range");
  // Titles stand in the order in which they are first used.
  if (with_output) add_output(list, o.output);
  add_settings(list, ping_settings(o));
  add_common(list, command.common);
  add_work(list, o.simulation.threads, o.simulation.seed);
}

Run complete_run(const PingCommand& command) {
  Run o = command.run;
  Placement& at = o.placement;
  // A run records its mounting, since its own file of the sonar does not hold it.
  const bool other_sonar = !command.of_run || o.head.sonar != command.of_run->head.sonar;
  if (!at.mount && other_sonar) at.mount = given_mounting(find_sonar(o.head.sonar));
  if (!command.of_run) return o;
  const Placement &run = command.of_run->placement, defaults;
  const bool new_pose = at.pose != run.pose, new_trajectory = at.trajectory != run.trajectory;
  if (new_pose && !new_trajectory) at.trajectory.clear();
  if (!new_trajectory || new_pose) return o;
  // A trajectory says all that a pose and its motion say.
  at.pose.reset();
  if (at.world == run.world) at.world = defaults.world;
  if (at.velocity == run.velocity) at.velocity.reset();
  if (at.turn_rate == run.turn_rate) at.turn_rate.reset();
  return o;
}

}  // namespace insonify::tool
