// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <vector>

#include "tiles/tile_file_internal.hpp"
#include "tiles/tile_writer.hpp"

// Private to tiles: surfels that are completed by their neighbours, in a scene that is larger than memory.
namespace insonify {

/// Completes all tiles of a file by options.complete, a group of neighbouring tiles at a time with the surfels around
/// them. Updates largest areas and checksums of the tiles. Returns the total area [m^2].
double complete_tiles(ColumnFile& columns, std::vector<TileEntry>& tiles, const TileWriterOptions& options,
                      const std::function<void(double)>& progress);

/// Returns the total area of all surfels in the tiles [m^2].
double sum_of_areas(const ColumnFile& columns, const std::vector<TileEntry>& tiles);

}  // namespace insonify
