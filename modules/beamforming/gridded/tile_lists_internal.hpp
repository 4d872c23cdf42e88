// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "acoustics/echoes.hpp"
#include "beamforming/pulses/pulse_loops_internal.hpp"
#include "beamforming/pulses/time_axis_internal.hpp"

namespace insonify {

/// Neighbouring tiles of `bins` bins each: those of the bins [first, last).
struct TileSpan {
  std::size_t bins, first, last;
};

/// Calls visit(tile, i) for every tile of a span that the pulse of echo i in [begin, end) overlaps, in order of echoes.
template <typename Visit>
void each_tile(const Echoes& echoes, std::size_t begin, std::size_t end, const TimeAxis& axis, const PulseReach& reach,
               const TileSpan& tiles, const Visit& visit) {
  constexpr std::size_t at_once = 512;
  std::uint32_t from[at_once], to[at_once];
  for (; begin < end; begin += at_once) {
    const std::size_t count = std::min(at_once, end - begin);
    kernels::reached_bins(echoes.delay.data() + begin, count,
                          {axis.start, axis.step, reach.half, reach.growth, static_cast<double>(tiles.first),
                           static_cast<double>(tiles.last)},
                          from, to);
    for (std::size_t i = 0; i < count; ++i)
      if (from[i] < to[i])
        for (std::size_t t = (from[i] - tiles.first) / tiles.bins; t <= (to[i] - 1 - tiles.first) / tiles.bins; ++t)
          visit(t, begin + i);
  }
}

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
