#pragma once
#include <string>
#include <vector>

#include "viewer/viewer_command.hpp"
#include "viewer/viewer_data.hpp"

namespace insonify::viewer {

struct LoadedView {
  ViewerData data;
  ViewerState start;
  std::vector<std::string> notes;  ///< for the user, one sentence each
};

/// True if the target is a run directory or a cube rather than a scene.
bool is_run(const std::string& target);

/// Reads a run: its cube, and contributors, returns and scene if they exist. Throws Error(file) if there is no
/// such run, Error(content) if it is unfinished or damaged, Error(argument) for options that do not fit it.
LoadedView load_run(const ViewerCommand& command);

/// Reads a scene to inspect. Throws as load_scene and find_sonar; Error(argument) without --sonar or --pose.
LoadedView load_inspection(const ViewerCommand& command);

}  // namespace insonify::viewer
