// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "sampling/direction_raster_internal.hpp"

namespace insonify {

/// Calls use(query, candidates) for each query, concurrently; `candidates` lists all surfels whose footprint cone
/// contains the query, and possibly others. The call may modify it.
template <typename Use>
void for_candidates(const GatedSurfels& surfels, std::span<const CubePoint> queries, int threads, const Use& use) {
  const DirectionRaster raster(surfels, queries, Footprint::cone, threads);
  parallel_for(raster.tiles(), threads, [&](std::size_t t) {
    const DirectionTile tile = raster.tile(t);
    if (tile.queries.empty()) return;
    CellLists<std::uint32_t> cells;
    for (std::uint32_t k = 0; k < tile.queries.size(); ++k) cells.add(k, tile.cell_of(queries[tile.queries[k]]));
    std::vector<std::vector<std::uint32_t>> candidates(tile.queries.size(), raster.wide());
    for (const TileBox& box : tile.boxes)
      cells.for_each(box, [&](std::uint32_t k) { candidates[k].push_back(box.surfel); });
    for (std::size_t k = 0; k < tile.queries.size(); ++k) use(tile.queries[k], candidates[k]);
  });
}

}  // namespace insonify
