// SPDX-License-Identifier: BSD-3-Clause
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
/// Returns the size of a line of text.
TextSize text_size(const std::string& text, int font_size);

/// A text at a font size <= `font_size` at which it fits into `width` [pixels]. Below seven tenths of `font_size` the
/// text is shortened with "..." instead.
struct FittedText {
  std::string text;
  int font_size = 0;
};
/// Returns the text fitted into `width`.
FittedText fit_text(const std::string& text, int font_size, double width);

/// A position in a picture [pixels from its lower left corner].
struct Point2 {
  double x = 0;
  double y = 0;
};
/// A rectangle of a picture [pixels from its lower left corner].
struct Box {
  double left = 0, right = 0, bottom = 0, top = 0;

  /// Returns the extent across.
  double width() const { return right - left; }
  /// Returns the extent upwards.
  double height() const { return top - bottom; }
  /// Returns true if the boxes share an area.
  bool overlaps(const Box& other) const {
    return left < other.right && other.left < right && bottom < other.top && other.bottom < top;
  }
  /// Returns true if a position lies inside, or on the left or lower edge.
  bool holds(Point2 position) const {
    return position.x >= left && position.x < right && position.y >= bottom && position.y < top;
  }
  /// Returns true if `other` lies inside, edges included.
  bool contains(const Box& other) const {
    return left <= other.left && other.right <= right && bottom <= other.bottom && other.top <= top;
  }
};

/// A line of text given by its centre. Its extent is measured once, by the constructor.
struct PlacedText {
  /// Measures the text.
  PlacedText(std::string line, Point2 middle, int size, bool reads_upwards = false)
      : text(std::move(line)), centre(middle), font_size(size), turned(reads_upwards), extent(text_size(text, size)) {}

  std::string text;
  Point2 centre;
  int font_size;
  bool turned;            ///< true: reads upwards
  bool on_plate = false;  ///< true: on a semi-transparent plate, for legibility on the data
  TextSize extent;        ///< size before rotation

  /// Returns the box that the text fills.
  Box box() const {
    const double x = (turned ? extent.height : extent.width) / 2, y = (turned ? extent.width : extent.height) / 2;
    return {centre.x - x, centre.x + x, centre.y - y, centre.y + y};
  }
};

/// A straight or curved line through points.
using Path = std::vector<Point2>;

}  // namespace insonify
