// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "viewer/viewer_data.hpp"
#include "viewer/viewer_script.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify {

/// Initial state of the viewer.
struct ViewerOptions {
  int width = 1600, height = 1000;  ///< size of the window [pixels]
  ViewerState start;
  std::vector<ViewerEvent> events;  ///< events that are played before user input is accepted
  /// Receives messages: explanations of samples, poses, names of screenshots. Empty: messages are dropped.
  std::function<void(const std::string&)> say;
};

/// Returns true if a window can be opened: the X server that DISPLAY names answers.
bool has_display();

/// Opens the viewer on the desktop and returns when the user or an event closes it. Panels of a run: the fan in true
/// geometry, the scene in 3-D with the head and the returns, the levels of a beam, a waterfall of it (one ping: the
/// levels across all beams), and an explanation of the selected sample. To inspect: the scene coloured by visibility.
/// Keys: viewer_keys. Throws Error(runtime), with the remedy, without a display; as require_viewable; Error(argument)
/// for a window smaller than 800 x 600 or larger than 8192 pixels in either direction, or a start outside the data's
/// extent.
void show_viewer(const ViewerData& data, const ViewerOptions& options);

/// Draws the window off-screen, without a display: plays the events and writes the final state as PNG. File errors as
/// show_fan.
void draw_viewer(const ViewerData& data, const ViewerOptions& options, const std::string& png_path);

}  // namespace insonify
