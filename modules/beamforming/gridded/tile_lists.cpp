// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "beamforming/gridded/tile_lists_internal.hpp"
#include "core/parallel.hpp"

namespace insonify {
namespace {

constexpr std::size_t min_block = 4096;  // least number of echoes per block of work
constexpr std::size_t max_blocks = 256;

}  // namespace

TileLists::TileLists(const Echoes& echoes, const TimeAxis& axis, const PulseReach& reach, std::size_t tile_bins,
                     int threads) {
  const std::size_t tiles = (axis.bins + tile_bins - 1) / tile_bins;
  const std::size_t block = std::max(min_block, (echoes.size() + max_blocks - 1) / max_blocks);
  const std::size_t blocks = (echoes.size() + block - 1) / block;

  std::vector<std::size_t> next(blocks * tiles, 0);
  const auto each = [&](const auto& visit) {
    parallel_blocks(echoes.size(), block, threads, [&](std::size_t first, std::size_t last) {
      std::size_t* of_tile = next.data() + first / block * tiles;
      each_tile(echoes, first, last, axis, reach, {tile_bins, 0, axis.bins},
                [&](std::size_t t, std::size_t i) { visit(of_tile[t], i); });
    });
  };
  each([](std::size_t& count, std::size_t) { ++count; });

  // Assign positions tile by tile, within a tile block by block, so the lists do not depend on the division into
  // blocks.
  begin.assign(1, 0);
  std::size_t count_before = 0;
  for (std::size_t t = 0; t < tiles; ++t) {
    for (std::size_t k = 0; k < blocks; ++k) {
      const std::size_t count = next[k * tiles + t];
      next[k * tiles + t] = count_before;
      count_before += count;
    }
    begin.push_back(count_before);
  }

  echo.resize(count_before);
  each([&](std::size_t& to, std::size_t i) { echo[to++] = static_cast<std::uint32_t>(i); });
}

}  // namespace insonify
