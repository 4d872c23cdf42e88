#pragma once
#include <string>

namespace insonify {

/// Width and height of a line of text [pixels]; the height is that of the font, whatever the letters.
struct TextSize {
  double width = 0;
  double height = 0;
};
TextSize text_size(const std::string& text, int font_size);

/// The text at a font size <= `font_size` at which it fits into `width` [pixels]; below seven tenths of `font_size` the
/// text is shortened with "..." instead.
struct FittedText {
  std::string text;
  int font_size = 0;
};
FittedText fit_text(const std::string& text, int font_size, double width);

}  // namespace insonify
