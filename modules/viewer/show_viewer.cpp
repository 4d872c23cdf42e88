// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/show_viewer.hpp"

#include "viewer/viewer_window_internal.hpp"

// Include Xlib after VTK's headers, because it defines common words as macros.
#include <X11/Xlib.h>

namespace insonify {

bool has_display() {
  Display* display = XOpenDisplay(nullptr);
  if (!display) return false;
  XCloseDisplay(display);
  return true;
}

void show_viewer(const ViewerData& data, const ViewerOptions& options) {
  ViewerWindow window(data, options, ViewerScreen::desktop);
  window.run(options.events);
}

void draw_viewer(const ViewerData& data, const ViewerOptions& options, const std::string& png_path) {
  ViewerWindow window(data, options, ViewerScreen::off_screen);
  window.run(options.events);
  window.save_png(png_path);
}

}  // namespace insonify
