// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/grid.hpp"

namespace insonify {

/// How far image A is displaced against image B.
struct ImageShift {
  int beams = 0, bins = 0;      ///< what B has at (beam, bin), A has at (beam + beams, bin + bins)
  double correlation = 0;       ///< of the smoothed levels at that shift
  double correlation_at_0 = 0;  ///< as the images are
};

/// Finds the whole shift of at most `max_beams` and `max_bins` at which the levels [dB], each averaged over 3 x 5
/// pixels, correlate best; 0 unless the correlation gains more than noise may give. NaN pixels are left out. Throws
/// Error(argument) if sizes differ. Cost: a quarter of the pixels for every shift.
ImageShift find_shift(const Grid<float>& a, const Grid<float>& b, int max_beams = 6, int max_bins = 24);

/// The image whose pixel (beam, bin) is that of `a` at (beam + shift.beams, bin + shift.bins): what find_shift found is
/// then
/// 0. NaN where `a` has none.
Grid<float> without_shift(const Grid<float>& a, const ImageShift& shift);

}  // namespace insonify
