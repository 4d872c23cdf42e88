#pragma once
#include <vector>

#include "view/canvas_internal.hpp"

namespace insonify {

/// Where marks may go and where not.
struct MarkRoom {
  Box box;                 ///< names stay within
  std::vector<Box> taken;  ///< and off these
  int font_size = 0;
  PlaneProjection at;
};

/// Marks inside a sector; their bearings are turned by whole circles to lie within [low, high].
std::vector<Mark> marks_within(const std::vector<Mark>& marks, double low, double high, const RangeGate& gate);

/// Draws a ring at each mark and its name beside it, at the nearest place where it covers no ring and no other text, with
/// a line between the two if they are apart. A name that finds no place is left out, the last ones first.
void draw_marks(Canvas& canvas, const std::vector<Mark>& marks, MarkRoom room);

}  // namespace insonify
