// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "viewer/viewer_layout.hpp"

namespace insonify {

/// A user action, for pictures and tests of the viewer.
struct ViewerEvent {
  /// Kind of the action.
  enum class Kind { click, drag, key, select, wait, screenshot, quit };
  Kind kind = Kind::quit;
  ViewerPanelName panel = ViewerPanelName::fan;  ///< panel of click and drag
  Point2 from, by;         ///< click, or begin and displacement of a drag [pixels], from the panel's lower left corner
  PixelPosition position;  ///< sample of select
  double seconds = 0;      ///< duration of wait
  std::string text;        ///< name of the key, or file of the screenshot
};

/// Returns the events of a text. Semicolons or line ends separate them; # starts a comment:
///   click PANEL X Y; drag PANEL X Y DX DY; key NAME; select BEAM BIN; wait SECONDS; screenshot FILE.png; quit
/// PANEL is a name of viewer_panels. Throws Error(argument) naming the event.
std::vector<ViewerEvent> parse_viewer_script(const std::string& text);

}  // namespace insonify
