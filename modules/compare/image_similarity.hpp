// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

#include "core/grid.hpp"
#include "returns/quantise.hpp"

namespace insonify {

/// Similarity of two images whose levels are clamped to a window.
struct ImageSimilarity {
  double mse = 0;      ///< mean squared difference [dB^2]
  double psnr_db = 0;  ///< 20 log10(span) - 10 log10(mse), span the width of the window; infinite for equal images
  double ssim = 0;     ///< mean structural similarity; NaN if no 11 x 11 window is whole
  std::size_t pixels = 0;
};

/// Returns MSE, PSNR and SSIM (E120) of two images of levels [dB], both clamped to `window`. Pixels where either is NaN
/// are left out, as are all SSIM windows with such a pixel. SSIM as Wang et al. 2004: Gaussian window of 11 x 11 with a
/// deviation of 1.5, K1 = 0.01, K2 = 0.03, moments of the population, mean over windows that lie within the image.
/// Throws Error(argument) if the images differ in size or the window is not finite with min_db < max_db, Error(content)
/// if no pixel is left.
ImageSimilarity image_similarity(const Grid<float>& a, const Grid<float>& b, const GreyWindow& window);

/// Returns 20 log10(span) - 10 log10(mse).
double psnr_db(double mse, double span);

}  // namespace insonify
