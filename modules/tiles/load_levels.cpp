// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "core/error.hpp"
#include "tiles/tile_levels_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d, Eigen::Vector3f;

DetailNode unpacked(const TileNode& n, const Vector3d& offset) {
  DetailNode to;
  const auto moved = [&](const float(&xyz)[3]) {
    const Vector3f p(xyz[0], xyz[1], xyz[2]);
    return offset.isZero(0) ? p : Vector3f((p.cast<double>() + offset).cast<float>());
  };
  to.point = moved(n.point), to.position = moved(n.position);
  to.normal = {n.normal[0], n.normal[1], n.normal[2]};
  std::copy_n(n.normals, to.normals.size(), to.normals.begin());
  to.area = n.area, to.extent = n.extent, to.thickness = n.thickness, to.cell = n.cell, to.own_area = n.own_area;
  to.nearest = n.id, to.first_child = n.first_child, to.children = n.children, to.material = n.material;
  return to;
}

/// A forest that is loaded from coarse to fine.
class LoadedForest : public LoadedLevels {
 public:
  LoadedForest(const ColumnFile& columns, const TileDirectory& directory, const TileForest& forest,
               const Vector3d& reference, std::atomic<std::uint64_t>& bytes)
      : columns_(columns), directory_(directory), forest_(forest), reference_(reference), bytes_(bytes) {
    levels.surfels = forest.rows;
    has_parent_.resize(forest.rows + forest.node_end[level_groups - 1]);
    levels.node.reserve(forest.node_end[level_groups - 1]);  // nodes keep their addresses
    levels.child.reserve(forest.child_end[level_groups - 1]);
    load_group();
    levels.root.assign(levels.child.begin(), levels.child.begin() + static_cast<std::ptrdiff_t>(forest.loose));
    for (std::uint32_t k = 0; k < levels.node.size(); ++k)
      levels.root.push_back(static_cast<std::uint32_t>(forest.rows) + k);
  }

  void need_node(std::size_t node) override {
    while (levels.node.size() <= node) load_group();
  }
  void need_surfel(std::size_t surfel) override {
    if (scene.size() == 0) resize(scene, forest_.rows, columns_.noisy()), loaded_.assign(forest_.tiles, false);
    const auto tiles = std::span(directory_.tiles).subspan(forest_.first_tile, forest_.tiles);
    const auto after = std::partition_point(
        tiles.begin(), tiles.end(), [&](const TileEntry& tile) { return tile.first <= forest_.first_row + surfel; });
    const auto t = static_cast<std::size_t>(after - tiles.begin()) - 1;
    if (loaded_[t]) return;
    loaded_[t] = true;
    bytes_ += tiles[t].count * columns_.surfel_bytes();
    read_tile(columns_, directory_, forest_.first_tile + t, reference_, scene, tiles[t].first - forest_.first_row);
  }

 private:
  void load_group() {
    const std::size_t g = group_++, first_node = levels.node.size(), first_child = levels.child.size();
    std::vector<TileNode> nodes(forest_.node_end[g] - first_node);
    std::vector<std::uint32_t> children(forest_.child_end[g] - first_child);
    columns_.file().read(directory_.nodes_begin + (forest_.first_node + first_node) * sizeof(TileNode),
                         bytes_in(nodes));
    columns_.file().read(directory_.children_begin + (forest_.first_child + first_child) * sizeof(std::uint32_t),
                         bytes_in(children));
    std::vector<float> noise(columns_.noisy() ? nodes.size() : 0);
    columns_.file().read(directory_.node_noise_begin + (forest_.first_node + first_node) * sizeof(float),
                         bytes_in(noise));
    const std::array<std::span<char>, 3> bytes{bytes_in(nodes), bytes_in(children), bytes_in(noise)};
    for (const std::span<char> each : bytes) bytes_ += each.size();
    if (checksum_of(bytes) != forest_.checksum[g])
      fail(ErrorKind::content, directory_.info.path, ": level ", g, " of the tiles from ", forest_.first_tile,
           " on is damaged: its checksum is wrong; copy or make the file again");
    if (g == 0)
      for (const std::uint32_t root : std::span(children).first(forest_.loose)) {
        if (root >= forest_.rows || has_parent_[root])
          fail(ErrorKind::content, directory_.info.path, ": the roots of the tiles from ", forest_.first_tile,
               " on are not different rows; copy or make the file again");
        has_parent_[root] = true;
      }
    levels.child.insert(levels.child.end(), children.begin(), children.end());
    const Vector3d offset = vector_in(forest_.reference) - reference_;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      DetailNode node = unpacked(nodes[k], offset);
      if (!noise.empty()) node.noise = noise[k];
      add_node(node, g);
    }
  }

  /// Adds a node of group `g`. Every row or node has one parent, in a coarser group, unless it is a root.
  void add_node(const DetailNode& node, std::size_t g) {
    const std::size_t number = levels.node.size();
    const auto require = [&](bool good, const auto&... what) {
      if (!good)
        fail(ErrorKind::content, directory_.info.path, ": node ", forest_.first_node + number, ": ", what...,
             "; copy or make the file again");
    };
    require_values(directory_, forest_.first_node + number, node);
    require(g == 0 || has_parent_[forest_.rows + number], "no coarser node has it as a child");
    require(node.first_child + std::uint64_t{node.children} <= levels.child.size(), "has children elsewhere");
    for (std::uint32_t k = 0; k < node.children; ++k) {
      const std::uint64_t child = levels.child[node.first_child + k], rows = forest_.rows;
      require(child < has_parent_.size() && (child < rows || child - rows >= forest_.node_end[g]), "its child ", child,
              " is neither a row nor a finer node");
      require(!has_parent_[child], "its child, ", child < rows ? "row " : "node ",
              child < rows ? forest_.first_row + child : forest_.first_node + child - rows, ", has another parent");
      has_parent_[child] = true;
    }
    levels.node.push_back(node);
  }

  const ColumnFile& columns_;
  const TileDirectory& directory_;
  const TileForest& forest_;
  Vector3d reference_;
  std::atomic<std::uint64_t>& bytes_;
  std::size_t group_ = 0;
  std::vector<bool> loaded_;      // per tile
  std::vector<bool> has_parent_;  // per row, then per node; also true for a root among the rows
};

}  // namespace

ForestSource::ForestSource(const ColumnFile& columns, const TileDirectory& directory, SceneCloud like,
                           const InsonifiedRegion& region, double most)
    : columns_(columns), directory_(directory), like_(std::move(like)), most_(most) {
  for (std::uint32_t f = 0; f < directory.forests.size(); ++f) {
    const TileForest& forest = directory.forests[f];
    if (may_intersect(region, directory.info.origin + vector_in(forest.centre), forest.radius, forest.largest_area))
      near_.push_back(f);
  }
}

std::unique_ptr<LoadedLevels> ForestSource::open(std::size_t piece) const {
  return std::make_unique<LoadedForest>(columns_, directory_, directory_.forests[near_[piece]],
                                        like_.origin - directory_.info.origin, bytes_);
}

void ForestSource::note(std::size_t taken) const {
  if (static_cast<double>(taken_ += taken) > most_)
    fail(ErrorKind::memory, directory_.info.path, ": the ", taken_, " surfels and nodes within reach need more memory ",
         "than may be used; shorten the range, use a narrower sonar or a coarser scene, or raise the limit");
}

}  // namespace insonify
