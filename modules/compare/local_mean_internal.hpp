// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/grid.hpp"

// Private to compare.
namespace insonify {

/// A box about a pixel, by the numbers of pixels to either side.
struct HalfWindow {
  Eigen::Index beams = 0, bins = 0;
};

/// Returns the mean over the box about each pixel, cut at the edges, of the values that are not NaN; NaN where there
/// are none.
Grid<double> local_mean(const Grid<double>& image, HalfWindow half);

}  // namespace insonify
