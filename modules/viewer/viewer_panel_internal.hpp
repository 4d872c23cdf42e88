// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "view/canvas_internal.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify {

/// A panel of the window: its content, and marks above it that change without redrawing the content.
struct ViewerPanel {
  vtkSmartPointer<vtkRenderer> content, marks;
};

/// Returns a panel of two renderers, in the window's lower and upper layer.
ViewerPanel add_panel(vtkRenderWindow* window);

/// Places a panel in its box; an empty box hides it.
void place_panel(ViewerPanel& panel, const Box& box, const int window_size[2]);

/// Returns the options of a drawing that fills a box of a dark window.
PictureOptions panel_options(const Box& box, int font_size);

/// Returns a canvas on an emptied renderer. `keep_camera` keeps the user's camera.
Canvas fresh_canvas(vtkRenderer* renderer, const PictureOptions& options, bool keep_camera);

/// Adds lines of text from the top of a box, truncated to its width; lines below its bottom are omitted.
void add_text_lines(Canvas& canvas, const std::string& text, const Box& box, int font_size);

/// A button as it was drawn.
struct PlacedButton {
  Box box;
  std::string key;  ///< key that a click on it presses
};

/// Draws rows of the table of keys from the top of a box, each with a button for every key. Returns the buttons in
/// coordinates of the box's picture. Rows that do not fit are left out, as are those about the mouse unless `mouse`.
std::vector<PlacedButton> draw_key_rows(Canvas& canvas, const std::vector<ViewerKey>& keys, const Box& box,
                                        int font_size, bool mouse);

/// Draws the whole table on a plate in the middle of a box, and returns its buttons.
std::vector<PlacedButton> draw_help(Canvas& canvas, ViewerMode mode, const Box& room, int font_size);

}  // namespace insonify
