// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>

#include "sonar/line_array.hpp"

namespace insonify {

/// Least kernel tolerance for which single precision suffices. Errors of kernel and rounding are distributed evenly
/// over all beams, so the kernel tolerance is the image tolerance times the fraction of the gridded energy that the
/// beams receive.
constexpr double single_precision_from = 2e-6;
/// Least tolerance of a kernel.
constexpr double min_kernel_tolerance = 1e-15;

/// Returns the expected GriddedImage::share of an echo among beams in the directions `cosines`: the root mean square of
/// the pattern over the extent of the beams.
double expected_share(const LineArray& array, double wavelength, std::span<const double> cosines);

}  // namespace insonify
