// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>

#include "run/run_settings.hpp"
#include "tool/command/option_list.hpp"

/// Options that several verbs share.
namespace insonify::tool {

/// --quiet and --verbose.
void add_verbosity(OptionList list, CommonOptions& options);
/// --quiet, --verbose and --json.
void add_common(OptionList list, CommonOptions& options);
/// --threads and --seed.
void add_work(OptionList list, int& threads, std::uint64_t& seed);
/// The options of settings.
void add_settings(OptionList list, const std::vector<RunSetting>& settings);
/// The scene that is required, and how it is completed.
void add_scene(OptionList list, SceneOptions& options);
/// How a scene is completed: viewpoint, materials, unit.
void add_completion(OptionList list, SceneOptions& options);
/// --sonar, which is required, the environment and the synthesis. `default_range` says what range holds by default.
void add_sonar(OptionList list, Run& run, const char* default_range = "the sonar's");
/// Takes --range.
OptionValue range_value(HeadOptions& options);
/// The run directory to make.
void add_output(OptionList list, OutputOptions& options);
/// --world, beside a --pose.
void add_world(OptionList list, std::string& world);

/// A ping as the command line gives it, perhaps beside the run.toml of an earlier one.
struct PingCommand {
  CommonOptions common;
  Run run;                         ///< run of the command line, which overrules that of --run
  std::optional<Run> of_run = {};  ///< if --run is given
};

/// Adds everything that says what a ping is: --run, scene, sonar, pose and so on. `with_output` adds the run directory.
void add_ping_options(OptionList list, PingCommand& command, bool with_output);

/// The run to make: a pose of the command line replaces a trajectory of --run, and a trajectory the pose.
Run complete_run(const PingCommand& command);

}  // namespace insonify::tool
