#pragma once
#include <string>

#include "tool/options.hpp"

namespace insonify::tool {

/// [scene] of the run.toml in a run directory as options of loading it, with paths looked up as by load_ping_settings.
/// Defaults, with an empty path, if there is no run.toml or no [scene] in it.
SceneOptions scene_of_run(const std::string& run);

}  // namespace insonify::tool
