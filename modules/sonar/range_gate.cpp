// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/range_gate.hpp"

#include <cmath>

#include "core/error.hpp"

namespace insonify {

std::size_t RangeGate::bins() const {
  // The factor avoids rounding a whole number of bins up to one more.
  return static_cast<std::size_t>(std::ceil((max_range - min_range) / bin_size * (1 - 1e-12)));
}

void require_valid(const RangeGate& gate, const char* who) {
  if (!(gate.min_range > 0 && std::isfinite(gate.min_range)))
    fail(ErrorKind::argument, who, ": gate.min_range = ", gate.min_range, " m, must be > 0");
  if (!(gate.max_range > gate.min_range && std::isfinite(gate.max_range)))
    fail(ErrorKind::argument, who, ": gate.max_range = ", gate.max_range,
         " m, must exceed gate.min_range = ", gate.min_range, " m");
  if (!(gate.bin_size > 0 && std::isfinite(gate.bin_size)))
    fail(ErrorKind::argument, who, ": gate.bin_size = ", gate.bin_size, " m, must be > 0");
  constexpr double most = 1 << 24;
  if ((gate.max_range - gate.min_range) / gate.bin_size > most)
    fail(ErrorKind::argument, who, ": gate.bin_size = ", gate.bin_size,
         " m makes more than 2^24 bins, must be larger or the gate shorter");
}

}  // namespace insonify
