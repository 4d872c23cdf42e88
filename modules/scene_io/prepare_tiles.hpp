// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <functional>
#include <string>

#include "scene_io/load_scene.hpp"
#include "tiles/tile_writer.hpp"

namespace insonify {

/// Options of prepare_tiles.
struct PrepareTilesOptions {
  LoadOptions load;
  std::size_t whole_points = 10'000'000;      ///< binary clouds with more points are streamed
  std::size_t memory = 256 << 20;             ///< memory for sorting [bytes]
  std::function<void(double)> progress = {};  ///< receives the completed fraction, 0..1; may throw to cancel
};

/// Result of prepare_tiles.
struct PreparedTiles {
  LoadReport report;
  TileReport tiles;
  bool normals_oriented = true;
  bool streamed = false;  ///< true: read in batches
};

/// Writes a cloud or mesh as a .tiles file and returns a report of all changes. Meshes, text and compressed files of
/// any size, and other files of at most `whole_points` points, are loaded whole and give the surfels of load_scene.
/// Larger binary PLY, uncompressed binary PCD, LAS and LAZ files are read twice in batches of rows, with these
/// differences:
///
///   - points whose normal is zero or NaN are dropped, not repaired,
///   - missing normals and areas are estimated a few tiles at a time (all areas, if some are negative or NaN); points
///     far from all others are not counted, and a viewpoint gives normals their side but no areas (E73),
///   - ids that do not ascend are replaced by row numbers,
///   - the orientation of normals is not compared with a viewpoint,
///   - noise that the file does not state is estimated only where normals are: else it is that of the options, or 0.
///
/// A raster of heights without normals is loaded whole. Tiles hold no surface between the points of a height field.
/// Throws as load_scene and TileWriter; Error(content) for such a raster that memory cannot hold.
PreparedTiles prepare_tiles(const std::string& path, const std::string& output,
                            const PrepareTilesOptions& options = {});

}  // namespace insonify
