#pragma once
#include <string>
#include <utility>
#include <vector>

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

/// A place in a picture [pixels from its lower left corner].
struct Point2 {
  double x = 0;
  double y = 0;
};
struct Box {
  double left = 0, right = 0, bottom = 0, top = 0;

  double width() const { return right - left; }
  double height() const { return top - bottom; }
  bool overlaps(const Box& other) const {
    return left < other.right && other.left < right && bottom < other.top && other.bottom < top;
  }
  bool contains(const Box& other) const {
    return left <= other.left && other.right <= right && bottom <= other.bottom && other.top <= top;
  }
};

/// A line of text given by its centre. Its extent is measured once, by the constructor.
struct PlacedText {
  PlacedText(std::string line, Point2 middle, int size, bool reads_upwards = false)
      : text(std::move(line)), centre(middle), font_size(size), turned(reads_upwards), extent(text_size(text, size)) {}

  std::string text;
  Point2 centre;
  int font_size;
  bool turned;            ///< reads upwards
  bool on_plate = false;  ///< on a semi-transparent plate, for legibility on the data
  TextSize extent;        ///< before rotation

  Box box() const {
    const double x = (turned ? extent.height : extent.width) / 2, y = (turned ? extent.width : extent.height) / 2;
    return {centre.x - x, centre.x + x, centre.y - y, centre.y + y};
  }
};

/// A straight or curved line through points.
using Path = std::vector<Point2>;

}  // namespace insonify
