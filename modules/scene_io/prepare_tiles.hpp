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
/// Larger binary PLY and uncompressed binary PCD files are read twice in batches of rows, with five differences:
///
///   - points whose normal is zero or NaN are dropped, not repaired,
///   - missing areas are estimated a few tiles at a time (all areas, if some are negative or NaN),
///   - ids that do not ascend are replaced by row numbers,
///   - the orientation of normals is not compared with a viewpoint,
///   - noise that the file does not state is not estimated: it is 0.
///
/// Throws as load_scene and TileWriter; Error(content) for a cloud without normals that must be read in batches.
PreparedTiles prepare_tiles(const std::string& path, const std::string& output,
                            const PrepareTilesOptions& options = {});

}  // namespace insonify
