// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "core/grid.hpp"

namespace insonify {

/// Full widths at half maximum of the autocovariance of intensity, in pixels. For speckle it is the square of the
/// modulus of the complex autocorrelation (Siegert).
struct CorrelationWidths {
  double beams = 0, bins = 0;
};

/// Statistics of intensities divided by their local mean (E123).
struct SpeckleStatistics {
  std::size_t pixels = 0;
  double scintillation = 0;       ///< variance / mean^2: 1 for one look of fully developed speckle
  double looks = 0;               ///< 1 / scintillation
  double k_shape = 0;             ///< 2 / (scintillation - 1); infinite for a scintillation of at most 1
  double amplitude_contrast = 0;  ///< deviation / mean of the amplitude: 0.5227 for one look
  double deviation_db = 0;        ///< deviation of the level: 5.57 dB for one look
  CorrelationWidths width;
  std::vector<double> covariance_beams, covariance_bins;  ///< at lags of 0, 1, ... pixels, 1 at 0
};

/// Returns the statistics of an image of levels [dB]; NaN pixels are left out. The local mean covers `half_beams` and
/// `half_bins` on either side, which removes slopes but also longer texture. Throws Error(argument) if no pixel has a
/// level, or all are silent.
SpeckleStatistics speckle_statistics(const Grid<float>& level_db, int half_beams = 8, int half_bins = 16);

/// Returns intensities over their local mean, one for each resolution cell: every ceil(width)th beam and bin. They are
/// nearly independent.
std::vector<double> one_per_cell(const Grid<float>& level_db, const CorrelationWidths& width, int half_beams = 8,
                                 int half_bins = 16);

/// Returns 10 log10 of the mean intensity of highlights over that of shadows: the tenth of the image where the mean
/// intensity over 5 beams x 9 bins is highest, and the tenth where it is lowest.
double shadow_contrast_db(const Grid<float>& level_db);

/// Returns the deviation [dB] of the level of `looks` independent looks: 10 / ln 10 sqrt(trigamma(looks)); 5.57 dB for
/// one.
double looks_deviation_db(double looks);
/// Returns the mean level less the level of the mean [dB] of `looks` looks: 10 / ln 10 (digamma(looks) - ln looks);
/// -2.51 dB for one.
double looks_bias_db(double looks);

}  // namespace insonify
