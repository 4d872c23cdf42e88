#pragma once
#include <functional>
#include <vector>

#include "scene_io/tile_file_internal.hpp"
#include "scene_io/tile_writer.hpp"

// Private to scene_io: surfel areas of a scene that is larger than memory.
namespace insonify {

/// Gives every surfel of the tiles in `file` its Voronoi area (E15), a few tiles at a time with all their neighbours, and
/// the tiles their largest areas and checksums. Areas are those of the whole cloud but for two things: of neighbours
/// equally far away others may be taken, and outliers are cut at 16 median spacings of their surroundings, not of the
/// cloud. Returns the sum.
double fill_areas(BinaryFile& file, std::vector<TileEntry>& tiles, const TileWriterOptions& options,
                  const std::function<void(double)>& progress);

/// Of all surfels in the tiles [m^2].
double sum_of_areas(const BinaryFile& file, const std::vector<TileEntry>& tiles);

}  // namespace insonify
