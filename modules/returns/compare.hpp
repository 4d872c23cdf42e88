// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/grid.hpp"

namespace insonify {

/// Difference between two complex images of the same size.
struct ImageDifference {
  double relative_l2 = 0;    ///< ||a - b|| / ||b||
  double max_level_db = 0;   ///< largest difference in level over samples within `window_db` of b's peak
  double correlation = 0;    ///< |<a, b>| / (||a|| ||b||): 1 same speckle, near 0 independent
  double mean_level_db = 0;  ///< level of the mean power of a minus that of b
};

/// Compares `a` with the reference `b`. Throws Error if the sizes differ or `b` is all zero.
ImageDifference compare_images(const ComplexGrid& a, const ComplexGrid& b, double window_db = 60);

}  // namespace insonify
