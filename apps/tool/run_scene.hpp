#pragma once
#include <optional>
#include <string>

#include "simulate/resolve_ping.hpp"
#include "tool/options.hpp"

namespace insonify::tool {

/// [scene] of the run.toml in a run directory as options of loading it, with paths looked up as by load_ping_settings.
/// Defaults, with an empty path, if there is no run.toml or no [scene] in it.
SceneOptions scene_of_run(const std::string& run);

/// How the head of a run, as its run.toml describes it, samples `scene`, wherever it stands; none without a
/// run.toml that has the sonar.
std::optional<View> view_of_run(const std::string& run, const WholeScene& scene, int threads);

}  // namespace insonify::tool
