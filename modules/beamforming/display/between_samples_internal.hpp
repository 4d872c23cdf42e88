// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "beamforming/numerics/gridding_kernel_internal.hpp"
#include "core/chebyshev.hpp"

namespace insonify {

/// Samples of a period that are repeated before it and behind it, for positions near its ends.
inline constexpr std::size_t guards_before = 4, guards_behind = 4;

/// Copies the samples at both ends of a period to the guards beyond the other end.
template <typename Number>
void repeat_ends(std::vector<Number>& samples) {
  const auto begin = samples.begin(), end = samples.end();
  std::copy(end - guards_behind - guards_before, end - guards_behind, begin);
  std::copy(begin + guards_before, begin + guards_before + guards_behind, end - guards_behind);
}

/// A position among the samples of a period with guards, and the weights of those about it (E186).
template <std::size_t width, typename Real = double>
struct Between {
  static_assert(width / 2 <= guards_before + 1 && width / 2 <= guards_behind);
  std::size_t first;
  std::array<Real, width> weight;
  template <typename Number>
  Number of(const Number* samples) const {
    Number sum = weight[0] * samples[first];
    for (std::size_t k = 1; k < width; ++k) sum += weight[k] * samples[first + k];
    return sum;
  }
};

/// Interpolates a function of few frequencies between the samples of a period, whose spectrum is divided by
/// `transform` (E186).
template <std::size_t width>
class SampleKernel {
 public:
  /// oversampling   sampling rate in twice the highest frequency, above 1
  explicit SampleKernel(double oversampling) : kernel_(width, oversampling), highest_(0.5 / oversampling) {
    for (std::size_t j = 0; j < nodes; ++j) transform_[j] = kernel_.transform(highest_ * chebyshev_node(j, nodes));
  }

  /// Returns a position >= 0 [samples] within a period.
  template <typename Real = double>
  Between<width, Real> at(double position) const {
    const double whole = std::floor(position);
    Between<width, Real> between{static_cast<std::size_t>(whole) + guards_before + 1 - width / 2, {}};
    for (std::size_t k = 0; k < width; ++k)
      between.weight[k] =
          static_cast<Real>(kernel_.at(position - whole + static_cast<double>(width / 2 - 1) - static_cast<double>(k)));
    return between;
  }
  /// Returns the transform at a frequency [cycles per sample] of at most `highest()`.
  double transform(double frequency) const {
    std::array<double, nodes> weight;
    lagrange(nodes, frequency / highest_, weight.data());
    return std::inner_product(weight.begin(), weight.end(), transform_.begin(), 0.0);
  }
  double highest() const { return highest_; }

 private:
  static constexpr std::size_t nodes = 24;
  GriddingKernel kernel_;
  double highest_;
  std::array<double, nodes> transform_;
};

}  // namespace insonify
