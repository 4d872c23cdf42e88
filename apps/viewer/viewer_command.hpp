// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "run/options.hpp"
#include "tool/command/common_options.hpp"
#include "viewer/viewer_data.hpp"

namespace insonify::viewer {

/// Options of insonify-view.
struct ViewerCommand {
  tool::CommonOptions common;
  SceneOptions scene;  ///< path: of --scene, or the target itself
  HeadOptions sonar;   ///< --sonar, --range and --set
  std::string target;  ///< run directory, cube.h5, recording, or scene
  std::string pose;
  std::string world = "z-up";
  std::string head;   ///< name of the head of a survey, or of the channel of a side-scan's recording; empty: the first
  std::string beam;   ///< number, or empty: nothing is selected
  ViewerState start;  ///< with ping, colour map and window
  std::string size = "1600x1000";
  std::string screenshot;  ///< file, or empty: a window
  bool force = false;
  bool no_scene = false;
  std::string events, script;
  std::optional<int> exit_code;  ///< set if nothing is left to do: help or version was asked for, or the usage is wrong
};
ViewerCommand parse_viewer_command(int argc, char** argv);

struct LoadedView {
  ViewerData data;
  ViewerState start;
  std::vector<std::string> notes;  ///< for the user, one sentence each
};

/// True if the target is a run directory, a cube or a recording rather than a scene.
bool is_run(const std::string& target);

/// Opens a run: its cube, whose pings are read as they are shown, and contributors, returns and scene if they exist. Of
/// a survey one head, merged or as far as its blocks are done. Throws Error(file) if there is no such run,
/// Error(content) if it is unfinished or damaged, Error(argument) for options that do not fit it.
LoadedView load_run(const ViewerCommand& command);

/// Reads a scene to inspect. Throws as load_scene and find_sonar; Error(argument) without --sonar or --pose.
LoadedView load_inspection(const ViewerCommand& command);

}  // namespace insonify::viewer
