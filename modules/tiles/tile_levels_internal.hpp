// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "sampling/scene_cut.hpp"
#include "tiles/tile_file_internal.hpp"

// Private to tiles: levels of detail (E137) of the surfels of a .tiles file, from coarse to fine.
namespace insonify {

/// Makes the levels of all surfels in `columns`, a few forests at a time, and appends nodes and children to `files`.
std::vector<TileForest> make_forests(const ColumnFile& columns, const TileDirectory& directory, double spacing,
                                     LevelFiles& files, int threads, const std::function<void(double)>& progress);

/// The forests of a file that may intersect a region.
class ForestSource : public LevelSource {
 public:
  /// Selects the forests. `most` limits surfels and nodes of a cut; `like` is that of LevelSource.
  ForestSource(const ColumnFile& columns, const TileDirectory& directory, SceneCloud like,
               const InsonifiedRegion& region, double most);
  const SceneCloud& like() const override { return like_; }
  bool noisy() const override { return columns_.noisy(); }
  std::size_t pieces() const override { return near_.size(); }
  std::unique_ptr<LoadedLevels> open(std::size_t piece) const override;
  void note(std::size_t taken) const override;
  /// Returns the number of bytes that were read.
  std::uint64_t bytes_read() const { return bytes_; }

 private:
  const ColumnFile& columns_;
  const TileDirectory& directory_;
  SceneCloud like_;
  double most_;
  std::vector<std::uint32_t> near_;
  mutable std::atomic<std::uint64_t> taken_ = 0, bytes_ = 0;
};

}  // namespace insonify
