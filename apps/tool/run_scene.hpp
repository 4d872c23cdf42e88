#pragma once
#include <string>

#include "tool/options.hpp"

namespace insonify::tool {

/// [scene] of a run's run.toml as options of loading it. The path is sought from here, from the run and from beside it;
/// empty if the run does not say, as it stands if it is nowhere.
SceneOptions scene_of_run(const std::string& run);

}  // namespace insonify::tool
