// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/grid.hpp"

// Private to compare: means over boxes.
namespace insonify {

/// A box about a pixel: numbers of pixels on either side.
struct HalfWindow {
  Eigen::Index beams = 0, bins = 0;
};

/// Returns the mean over the box about each pixel, cut at the edges. NaN is left out; a box of NaN alone gives NaN.
Grid<double> local_mean(const Grid<double>& image, HalfWindow half);

}  // namespace insonify
