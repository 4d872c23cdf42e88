// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <vector>

#include "tiles/tile_file_internal.hpp"
#include "tiles/tile_writer.hpp"

// Private to tiles: surfel areas of a scene that is larger than memory.
namespace insonify {

/// Computes the Voronoi area (E15) of every surfel of the tiles in a file, a few tiles at a time with all their
/// neighbours, and updates largest areas and checksums of the tiles. Areas equal those of the whole cloud with two
/// exceptions: ties between equidistant neighbours may be resolved differently, and outliers are clipped at 16 median
/// spacings of their surroundings, not of the cloud. Returns the total area [m^2].
double fill_areas(ColumnFile& columns, std::vector<TileEntry>& tiles, const TileWriterOptions& options,
                  const std::function<void(double)>& progress);

/// Returns the total area of all surfels in the tiles [m^2].
double sum_of_areas(const ColumnFile& columns, const std::vector<TileEntry>& tiles);

}  // namespace insonify
