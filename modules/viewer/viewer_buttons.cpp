// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "viewer/viewer_panel_internal.hpp"

namespace insonify {
namespace {

constexpr double row_letters = 1.6;  // height of a row in sizes of its letters

// Draws a plate with its label. Returns its end.
double add_button(Canvas& canvas, const ViewerButton& button, Point2 left_middle, int font,
                  std::vector<PlacedButton>& placed) {
  const std::string label = key_label(button.key);
  const double half = 0.68 * font, text = text_size(label, font).width;
  const double width = std::max(text + 0.8 * font, 1.7 * font);
  const Box box{left_middle.x, left_middle.x + width, left_middle.y - half, left_middle.y + half};
  canvas.add_plate(box, canvas.colours().line, 0.28);
  canvas.add_text({label, {left_middle.x + width / 2, left_middle.y}, font});
  placed.push_back({box, button.key});
  return box.right;
}

}  // namespace

std::vector<PlacedButton> draw_key_rows(Canvas& canvas, const std::vector<ViewerKey>& keys, const Box& box, int font,
                                        bool mouse) {
  std::vector<PlacedButton> placed;
  const double row = row_letters * font, gap = 0.35 * font;
  double middle = box.top - row / 2;
  for (const ViewerKey& key : keys) {
    if (key.buttons.empty() && !mouse) continue;
    if (middle - row / 2 < box.bottom) break;
    double left = box.left;
    for (const ViewerButton& button : key.buttons)
      left = add_button(canvas, button, {left, middle}, font, placed) + gap;
    if (key.buttons.empty()) left = canvas.add_text_from({left, middle}, key.mouse, font, box.width() / 3) + gap;
    canvas.add_text_from({left + gap, middle}, key.action, font, box.right - left - gap);
    middle -= row;
  }
  return placed;
}

std::vector<PlacedButton> draw_help(Canvas& canvas, ViewerMode mode, const Box& room, int font) {
  const std::vector<ViewerKey> keys = viewer_keys(mode);
  const double row = row_letters * font, height = row * static_cast<double>(keys.size() + 3), width = 40.0 * font;
  const double left = (room.width() - width) / 2, top = (room.height() + height) / 2;
  canvas.add_plate({left, left + width, top - height, top}, canvas.colours().background, 0.94);
  canvas.add_text({"Keys", {left + width / 2, top - row}, (5 * font) / 4});
  return draw_key_rows(canvas, keys, {left + 1.5 * font, left + width - font, top - height, top - 2 * row}, font, true);
}

}  // namespace insonify
