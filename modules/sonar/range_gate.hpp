// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

namespace insonify {

/// The range axis. Bin n covers [min_range + n bin_size, min_range + (n + 1) bin_size]; samples are taken at bin
/// centres.
struct RangeGate {
  double min_range = 0;  ///< [m]
  double max_range = 0;  ///< [m]
  double bin_size = 0;   ///< [m]

  std::size_t bins() const;  ///< number of bins that covers max_range
  /// Returns the range of the middle of a bin [m].
  double centre(std::size_t bin) const { return min_range + (static_cast<double>(bin) + 0.5) * bin_size; }
  bool operator==(const RangeGate&) const = default;
};

/// Throws Error unless 0 < min_range < max_range, 0 < bin_size, all finite, and at most 2^24 bins.
void require_valid(const RangeGate& gate, const char* who);

}  // namespace insonify
