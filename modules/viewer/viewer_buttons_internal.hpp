// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "viewer/viewer_panel_internal.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify {

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
