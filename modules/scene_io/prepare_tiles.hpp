#pragma once
#include <cstddef>
#include <functional>
#include <string>

#include "scene_io/load_scene.hpp"
#include "scene_io/tile_writer.hpp"

namespace insonify {

struct PrepareTilesOptions {
  LoadOptions load;
  std::size_t whole_points = 10'000'000;      ///< binary clouds of more points are never held in memory
  std::size_t memory = 256 << 20;             ///< [bytes] that sorting may take
  std::function<void(double)> progress = {};  ///< called with the part that is done, 0..1; may throw to give up
};

struct PreparedTiles {
  LoadReport report;
  TileReport tiles;
  bool normals_oriented = true;
  bool streamed = false;  ///< read in batches, and never held in memory
};

/// Prepares a cloud or mesh as a .tiles file. Files that load_scene can complete as a whole hold the same surfels then:
/// those of at most `whole_points` points, and meshes, text and compressed files of any size. Binary PLY and uncompressed
/// binary PCD of more points are read twice in batches of rows, with four things done otherwise: points whose normal is
/// zero or NaN are dropped, not repaired; areas that are missing are found a few tiles at a time (so are all if some are
/// negative or NaN); ids that do not ascend become row numbers; the side of normals is not held against a viewpoint.
/// Everything is counted in the report. Throws as load_scene and TileWriter; Error(content) for a cloud to be read in
/// batches that has no normals.
PreparedTiles prepare_tiles(const std::string& path, const std::string& output,
                            const PrepareTilesOptions& options = {});

}  // namespace insonify
