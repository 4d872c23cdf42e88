#pragma once
#include <optional>

#include "tool/option_list.hpp"
#include "tool/options.hpp"

namespace insonify::tool {

/// A ping as the command line gives it, perhaps beside the run.toml of an earlier one.
struct PingCommand {
  PingOptions options;                     ///< of the command line, over those of --run
  std::optional<PingOptions> of_run = {};  ///< if --run is given
};

/// Adds everything that says what a ping is: --run, scene, sonar, pose and so on. `with_output` adds the run directory.
void add_ping_options(OptionList list, PingCommand& command, bool with_output);

/// The options to use: a pose of the command line replaces a trajectory of --run, and a trajectory the pose.
PingOptions settled_options(const PingCommand& command);

}  // namespace insonify::tool
