// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/grid.hpp"

namespace insonify {

/// Displacement of image A against image B.
struct ImageShift {
  int beams = 0, bins = 0;      ///< pixel (beam, bin) of B is pixel (beam + beams, bin + bins) of A
  double correlation = 0;       ///< correlation of the smoothed levels at that shift
  double correlation_at_0 = 0;  ///< correlation without a shift
};

/// Finds the whole shift of at most `max_beams` and `max_bins` at which the levels [dB], each averaged over 3 x 5
/// pixels, correlate best; 0 unless the correlation gains more than noise may give. NaN pixels are left out. Throws
/// Error(argument) if sizes differ. Cost: a quarter of the pixels for every shift.
ImageShift find_shift(const Grid<float>& a, const Grid<float>& b, int max_beams = 6, int max_bins = 24);

/// Returns the image whose pixel (beam, bin) is that of `a` at (beam + shift.beams, bin + shift.bins), NaN where `a`
/// has no pixel. find_shift of the result is 0.
Grid<float> without_shift(const Grid<float>& a, const ImageShift& shift);

}  // namespace insonify
