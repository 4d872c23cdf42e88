// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "viewer/viewer_command.hpp"

namespace insonify::viewer {

/// Adds the scene of the run in `run_folder` to a view that has its pings, and notes on it; of a scene of parts that of
/// each ping. Without the scene, or with contributors of another one, a note says so. Throws as load_any_scene and
/// PartsOfPings.
void show_scene_of_run(const ViewerCommand& command, const std::string& run_folder, LoadedView& view);

}  // namespace insonify::viewer
