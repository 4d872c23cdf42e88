#pragma once
#include <functional>
#include <string>
#include <vector>

#include "viewer/viewer_data.hpp"
#include "viewer/viewer_script.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify {

struct ViewerOptions {
  int width = 1600, height = 1000;  ///< of the window [pixels]
  ViewerState start;
  std::vector<ViewerEvent> events;  ///< played before the user has a turn
  /// Gets what the viewer has to say: explanations of samples, poses, names of screenshots. Nothing: it is dropped.
  std::function<void(const std::string&)> say;
};

/// True if there is a display to open a window on: the X server that DISPLAY names answers.
bool has_display();

/// Opens the viewer on the desktop and returns when the user closes it, or an event did. Panels of a run: the fan in true
/// geometry, the scene in 3-D with the head and the returns, the levels of a beam, and a waterfall of it (one ping: the
/// levels across all beams), with an explanation of the sample that is selected; to inspect: the scene coloured by what
/// the head sees. Keys: viewer_keys. Throws Error(runtime) without a display, with the remedy; as require_viewable;
/// Error(argument) for a window not of 800 x 600 to 8192 pixels either way, or a start out of the data's extent.
void show_viewer(const ViewerData& data, const ViewerOptions& options);

/// The same window without a display: draws it off-screen, plays the events, and writes what stands then as PNG. Files as
/// in show_fan.
void draw_viewer(const ViewerData& data, const ViewerOptions& options, const std::string& png_path);

}  // namespace insonify
