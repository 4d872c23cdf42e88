// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "acoustics/echoes.hpp"
#include "beamforming/pulses/time_axis_internal.hpp"
#include "sonar/water.hpp"

namespace insonify {

/// Lists of the echoes that overlap each tile of bins, in order of echoes, for any number of threads.
struct TileLists {
  std::vector<std::size_t> begin;   ///< tiles + 1 offsets into `echo`
  std::vector<std::uint32_t> echo;  ///< indices of echoes, fewer than 2^32

  TileLists(const Echoes& echoes, const TimeAxis& axis, const PulseReach& reach, std::size_t tile_bins, int threads);

  std::size_t tiles() const { return begin.size() - 1; }
  std::span<const std::uint32_t> of(std::size_t tile) const {
    return {echo.data() + begin[tile], begin[tile + 1] - begin[tile]};
  }
};

}  // namespace insonify
