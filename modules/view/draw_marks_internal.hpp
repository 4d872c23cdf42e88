#pragma once
#include <vector>

#include "view/canvas_internal.hpp"

namespace insonify {

/// Space available for marks.
struct MarkRoom {
  Box box;                 ///< contains all names
  std::vector<Box> taken;  ///< not to be covered by names
  int font_size = 0;
  PlaneProjection at;
};

/// The marks inside a sector, with whole turns added to their bearings so that they lie within [low, high].
std::vector<Mark> marks_within(const std::vector<Mark>& marks, double low, double high, const RangeGate& gate);

/// Draws a ring at each mark and its name at the nearest place where it covers no ring and no other text, with a leader
/// line if the two are apart. Names without a free place are omitted; earlier marks have priority.
void draw_marks(Canvas& canvas, const std::vector<Mark>& marks, MarkRoom room);

}  // namespace insonify
