// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/target_clones.hpp"
#include "sonar/element_kernels_internal.hpp"

namespace insonify::kernels {
namespace {
constexpr std::size_t lanes = 8;
constexpr std::size_t most_bins = 64;
}  // namespace

INSONIFY_CLONES
void element_phases(double step, std::size_t elements, double* re, double* im) {
  // Compute eight neighbouring phasors by repeated multiplication, then rotate all eight by 8 steps at a time: short
  // recurrences that vectorise, with two sines per call.
  const double first = -0.5 * (static_cast<double>(elements) - 1) * step;
  const double one_r = std::cos(step), one_i = std::sin(step);
  double r[lanes] = {std::cos(first)}, i[lanes] = {std::sin(first)};
  double turn_r = one_r, turn_i = one_i;
  for (std::size_t known = 1; known < lanes; known *= 2) {
    for (std::size_t l = 0; l < known; ++l) {
      r[known + l] = r[l] * turn_r - i[l] * turn_i;
      i[known + l] = r[l] * turn_i + i[l] * turn_r;
    }
    const double squared = turn_r * turn_r - turn_i * turn_i;
    turn_i = 2 * turn_r * turn_i;
    turn_r = squared;
  }
  std::size_t m = 0;
  for (; m + lanes <= elements; m += lanes) {
    for (std::size_t l = 0; l < lanes; ++l) {
      re[m + l] = r[l];
      im[m + l] = i[l];
      const double next = r[l] * turn_r - i[l] * turn_i;
      i[l] = r[l] * turn_i + i[l] * turn_r;
      r[l] = next;
    }
  }
  for (std::size_t l = 0; m < elements; ++m, ++l) {
    re[m] = r[l];
    im[m] = i[l];
  }
}

INSONIFY_CLONES
void sum_elements(const double* __restrict s_re, const double* __restrict s_im, std::size_t elements,
                  const double* __restrict x_re, const double* __restrict x_im, std::size_t stride, std::size_t bins,
                  double* __restrict beam_re, double* __restrict beam_im) {
  double sum_re[most_bins], sum_im[most_bins];
  std::fill(sum_re, sum_re + most_bins, 0.0);
  std::fill(sum_im, sum_im + most_bins, 0.0);
  for (std::size_t m = 0; m < elements; ++m) {
    const double a = s_re[m], b = s_im[m];
    const double* row_re = x_re + m * stride;
    const double* row_im = x_im + m * stride;
    for (std::size_t n = 0; n < bins; ++n) {
      sum_re[n] += a * row_re[n] - b * row_im[n];
      sum_im[n] += a * row_im[n] + b * row_re[n];
    }
  }
  std::copy(sum_re, sum_re + bins, beam_re);
  std::copy(sum_im, sum_im + bins, beam_im);
}

}  // namespace insonify::kernels
