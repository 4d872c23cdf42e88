#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "tool/options.hpp"

namespace insonify::viewer {

/// Options of insonify-view.
struct ViewerCommand {
  tool::CommonOptions common;
  tool::SceneOptions scene;  ///< path: of --scene, or the target itself
  tool::RunOptions run;      ///< of which sonar, range and environment count
  std::string target;        ///< run directory, cube.h5, or scene
  std::string pose;
  std::string world = "z-up";
  std::uint64_t ping = 0;
  std::string beam;  ///< number, or empty: nothing is selected
  std::string colour_map = "copper";
  double window_db = 45;
  std::string size = "1600x1000";
  std::string screenshot;  ///< file, or empty: a window
  bool force = false;
  bool no_scene = false;
  std::string events, script;
  std::optional<int> exit_code;  ///< set if nothing is left to do: help or version was asked for, or the usage is wrong
};
ViewerCommand parse_viewer_command(int argc, char** argv);

}  // namespace insonify::viewer
