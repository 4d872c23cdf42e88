#pragma once
#include <optional>
#include <string>

#include "simulate/resolve_ping.hpp"
#include "tool/options.hpp"

namespace insonify::tool {

/// [scene] of a run's run.toml as options of loading it. The path is sought from here, from the run and from beside it;
/// empty if the run does not say, as it stands if it is nowhere.
SceneOptions scene_of_run(const std::string& run);

/// How the head of a run, as its run.toml describes it, samples `scene`, wherever it stands; none without a
/// run.toml that has the sonar.
std::optional<View> view_of_run(const std::string& run, const WholeScene& scene, int threads);

}  // namespace insonify::tool
