#include "tool/shared_options.hpp"

#include "tool/run_settings.hpp"

namespace insonify::tool {

void add_common(OptionList list, CommonOptions& o, bool json) {
  list.add("-q,--quiet", &o.quiet, "errors only");
  list.add("-v,--verbose", &o.verbose, "say each step");
  if (json) list.add("--json", &o.json, "result as JSON on stdout");
}

void add_work(OptionList list, CommonOptions& o) {
  list.add("-j,--threads", &o.threads, "threads, at most 1024; 0: all cores (results do not depend on it)",
           {.within = std::pair(0, 1024)});
  add_settings(list, {seed_setting(o)});
}

void add_completion(OptionList list, SceneOptions& o) {
  const auto settings = scene_settings(o);
  add_settings(list, {settings.begin() + 1, settings.end()});
}

void add_sonar(OptionList list, CommonOptions& common, RunOptions& o) {
  list.add("--sonar", &o.sonar, "preset (see `insonify sonars`), a .toml file, or the run.toml of a run",
           {.required = true});
  list.add("--range", &o.range, "min:max [m]; default: the sonar's");
  add_settings(list, synthesis_settings(o));
  list.add("--environment", &o.environment,
           "TOML file: [water] [surface] [bottom] [volume] [wind] [noise] [profile], or the run.toml of a run");
  list.add("--profile", &o.profile, "CSV depth_m,sound_speed (or depth_m,temperature_c,salinity_psu): bends rays");
  list.add("--set", &common.settings, "SECTION.KEY=VALUE of sonar or environment, e.g. water.temperature_c=4",
           {.one_each = true});
}

void add_output(OptionList list, RunOptions& o) {
  list.add("-o,--output", &o.output, "run directory to make", {.required = true});
  list.add("--force", &o.force, "replace an existing run directory");
  list.add("--no-picture", &o.no_picture, "do not draw fan.png");
}

void add_world(OptionList list, std::string& world) {
  list.add("--world", &world, "z-up, or ned: z down, pitch positive nose up", {.words = {"z-up", "ned"}});
}

}  // namespace insonify::tool
