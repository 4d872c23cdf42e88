#pragma once
#include "tool/option_list.hpp"
#include "tool/options.hpp"

/// Options that several verbs share.
namespace insonify::tool {

/// --quiet, --verbose, and --json if the verb has results that a machine may read.
void add_common(OptionList list, CommonOptions& options, bool json);
/// --threads and --seed.
void add_work(OptionList list, CommonOptions& options);
/// How a scene is completed: viewpoint, materials, unit.
void add_completion(OptionList list, SceneOptions& options);
/// --sonar, which is required, the environment and the synthesis.
void add_sonar(OptionList list, CommonOptions& common, RunOptions& options);
/// The run directory to make.
void add_output(OptionList list, RunOptions& options);
/// --world, beside a --pose.
void add_world(OptionList list, std::string& world);

}  // namespace insonify::tool
