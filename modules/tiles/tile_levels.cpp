// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "tiles/tile_levels_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d, Eigen::Vector3f;

constexpr std::size_t rows_at_once = 1 << 19;  // rows of the forests that are made at once
constexpr int leaves_from = 6;                 // doublings of the smallest cell; below larger cells a surfel is a node
constexpr std::size_t rows_per_leaf = 8;       // a forest with more roots that are surfels keeps them as rows
constexpr std::uint32_t not_in_file = ~std::uint32_t{0};

std::array<std::int64_t, 3> cube_of(const Vector3d& position, double edge) {
  const Vector3d cell = (position / edge).array().floor();
  return {static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y()),
          static_cast<std::int64_t>(cell.z())};
}

/// Divides the tiles into forests: each holds whole cubes of the largest cells.
std::vector<TileForest> plan_forests(const ColumnFile& columns, const TileDirectory& directory, double edge) {
  std::vector<TileForest> forests;
  std::array<std::int64_t, 3> last{};
  const auto cube_at = [&](const TileEntry& tile, std::uint64_t row) {
    SceneCloud one;
    resize(one, 1, columns.noisy());
    columns.read(row, rows_of(one, 0, 1));
    return cube_of(vector_in(tile.reference) + one.point[0].cast<double>(), edge);
  };
  for (std::size_t t = 0; t < directory.tiles.size(); ++t) {
    const TileEntry& tile = directory.tiles[t];
    if (tile.count == 0) continue;
    if (forests.empty() || cube_at(tile, tile.first) != last) {
      TileForest& f = forests.emplace_back();
      f.first_tile = t, f.first_row = tile.first;
      std::copy_n(tile.reference, 3, f.reference);
    }
    forests.back().tiles = t + 1 - forests.back().first_tile;
    forests.back().rows += tile.count;
    last = cube_at(tile, tile.first + tile.count - 1);
  }
  for (TileForest& f : forests) {
    const std::span tiles(directory.tiles.data() + f.first_tile, f.tiles);
    Vector3d low = vector_in(tiles[0].centre), high = low;
    for (const TileEntry& tile : tiles)
      low = low.cwiseMin(vector_in(tile.centre)), high = high.cwiseMax(vector_in(tile.centre));
    const Vector3d centre = (low + high) / 2;
    for (const TileEntry& tile : tiles) {
      const double reach = (vector_in(tile.centre) - centre).norm() + tile.radius;
      f.radius = std::max(f.radius, static_cast<float>(reach * (1 + 1e-6)));
      f.largest_area = std::max(f.largest_area, tile.largest_area);
    }
    Eigen::Map<Vector3d>(f.centre) = centre;
  }
  return forests;
}

/// The levels of a forest in the form of the file.
struct PackedLevels {
  std::vector<TileNode> nodes;
  std::vector<std::uint32_t> children;
  std::vector<float> noise;  ///< noise of the nodes; empty if the surfels have none
};

TileNode packed(const DetailNode& n, std::uint32_t id) {
  TileNode to{};
  Eigen::Map<Vector3f>(to.point) = n.point;
  Eigen::Map<Vector3f>(to.normal) = n.normal;
  Eigen::Map<Vector3f>(to.position) = n.position;
  std::copy(n.normals.begin(), n.normals.end(), to.normals);
  to.area = n.area, to.extent = n.extent, to.thickness = n.thickness, to.cell = n.cell, to.own_area = n.own_area;
  to.id = id, to.first_child = n.first_child, to.children = n.children, to.material = n.material;
  return to;
}

/// Orders the nodes of levels of detail (E137) by groups, from coarse to fine.
class LevelPacker {
 public:
  /// Makes the levels of `rows`, which have the order of the file.
  LevelPacker(const SceneCloud& rows, double spacing) : row_(rows.size()), leaf_(rows.size(), not_in_file) {
    // Sort by ascending id as in memory, so that the levels are the same.
    std::iota(row_.begin(), row_.end(), 0);
    std::sort(row_.begin(), row_.end(), [&](std::uint32_t a, std::uint32_t b) { return rows.id[a] < rows.id[b]; });
    surfels_ = subset(rows, row_);
    levels_ = detail_levels(surfels_, spacing, 1);
    position_.assign(levels_.node.size(), not_in_file);
    if (spacing > 0) finest_ = std::ilogb(finest_cell(spacing));
  }

  PackedLevels pack(TileForest& forest) {
    add_roots(forest);
    for (std::size_t g = 0; g < level_groups; ++g)
      for (std::size_t k = 0; k < group_[g].size(); ++k)
        if (group_[g][k] >= levels_.surfels) add_children(levels_.node[group_[g][k] - levels_.surfels]);
    // All groups are known now: number their nodes.
    std::uint32_t next = 0;
    for (const std::vector<std::uint32_t>& group : group_)
      for (const std::uint32_t index : group)
        (index < levels_.surfels ? leaf_[index] : position_[index - levels_.surfels]) = next++;
    for (std::size_t g = 0; g < level_groups; ++g) write_group(g, forest);
    return std::move(packed_);
  }

 private:
  void add_roots(TileForest& forest) {
    const auto is_surfel = [&](std::uint32_t index) { return index < levels_.surfels; };
    const auto single = static_cast<std::size_t>(std::count_if(levels_.root.begin(), levels_.root.end(), is_surfel));
    for (const std::uint32_t root : levels_.root) {
      if (is_surfel(root) && single * rows_per_leaf > levels_.surfels)
        packed_.children.push_back(row_[root]);
      else
        group_[0].push_back(root);
    }
    forest.loose = packed_.children.size();
  }
  void add_children(const DetailNode& node) {
    const int doublings = std::ilogb(node.cell) - finest_;
    for (std::uint32_t k = 0; k < node.children; ++k)
      if (const std::uint32_t child = levels_.child[node.first_child + k];
          child >= levels_.surfels || doublings >= leaves_from)
        group_[static_cast<std::size_t>(1 + detail_doublings - doublings)].push_back(child);
  }
  void write_group(std::size_t g, TileForest& forest) {
    const std::size_t first_node = packed_.nodes.size(), first_child = g == 0 ? 0 : packed_.children.size();
    for (const std::uint32_t index : group_[g]) {
      if (index < levels_.surfels) {
        write_leaf(index);
        continue;
      }
      DetailNode node = levels_.node[index - levels_.surfels];
      const std::uint32_t children = node.first_child;
      node.first_child = static_cast<std::uint32_t>(packed_.children.size());
      for (std::uint32_t k = 0; k < node.children; ++k)
        packed_.children.push_back(number_of(levels_.child[children + k]));
      add(node, surfels_.id[node.nearest]);
    }
    forest.node_end[g] = static_cast<std::uint32_t>(packed_.nodes.size());
    forest.child_end[g] = static_cast<std::uint32_t>(packed_.children.size());
    std::span<char> noise = bytes_in(packed_.noise);
    if (!noise.empty()) noise = noise.subspan(first_node * sizeof(float));
    const std::array<std::span<char>, 3> bytes{bytes_in(packed_.nodes).subspan(first_node * sizeof(TileNode)),
                                               bytes_in(packed_.children).subspan(first_child * sizeof(std::uint32_t)),
                                               noise};
    forest.checksum[g] = checksum_of(bytes);
  }
  void write_leaf(std::uint32_t i) {
    DetailNode node;
    node.point = node.position = surfels_.point[i];
    node.normal = surfels_.normal[i];
    node.area = node.own_area = surfels_.area[i];
    node.material = surfels_.material[i];
    node.first_child = static_cast<std::uint32_t>(packed_.children.size());
    if (!surfels_.noise.empty()) node.noise = surfels_.noise[i];
    add(node, surfels_.id[i]);
  }
  void add(const DetailNode& node, std::uint32_t id) {
    packed_.nodes.push_back(packed(node, id));
    if (!surfels_.noise.empty()) packed_.noise.push_back(node.noise);
  }
  /// Returns the number of a child in the file.
  std::uint32_t number_of(std::uint32_t index) const {
    const auto rows = static_cast<std::uint32_t>(levels_.surfels);
    if (index >= rows) return rows + position_[index - rows];
    return leaf_[index] == not_in_file ? row_[index] : rows + leaf_[index];
  }

  std::vector<std::uint32_t> row_;              // row of each surfel, by id
  std::vector<std::uint32_t> leaf_, position_;  // number in the file of each surfel that is a node, and of each node
  SceneCloud surfels_;
  DetailLevels levels_;
  int finest_ = 0;
  std::array<std::vector<std::uint32_t>, level_groups> group_;
  PackedLevels packed_;
};

}  // namespace

std::vector<TileForest> make_forests(const ColumnFile& columns, const TileDirectory& directory, double spacing,
                                     LevelFiles& files, int threads, const std::function<void(double)>& progress) {
  const double edge = spacing > 0 ? std::ldexp(finest_cell(spacing), detail_doublings) : 1;
  std::vector<TileForest> forests = plan_forests(columns, directory, edge);
  for (std::size_t begin = 0, end; begin < forests.size(); begin = end) {
    std::size_t rows = 0;
    for (end = begin; end < forests.size() && (end == begin || rows + forests[end].rows <= rows_at_once); ++end)
      rows += forests[end].rows;
    std::vector<PackedLevels> made(end - begin);
    parallel_for(made.size(), threads, [&](std::size_t k) {
      TileForest& f = forests[begin + k];
      SceneCloud surfels;
      surfels.materials = directory.info.materials;
      surfels.normals_oriented = directory.info.normals_oriented;
      resize(surfels, f.rows, columns.noisy());
      for (std::size_t t = f.first_tile; t < f.first_tile + f.tiles; ++t)
        read_tile(columns, directory, t, vector_in(f.reference), surfels, directory.tiles[t].first - f.first_row);
      made[k] = LevelPacker(surfels, spacing).pack(f);
    });
    for (std::size_t k = 0; k < made.size(); ++k) {
      forests[begin + k].first_node = files.node_count, forests[begin + k].first_child = files.child_count;
      files.nodes.write(files.node_count * sizeof(TileNode), bytes_in(made[k].nodes));
      files.children.write(files.child_count * sizeof(std::uint32_t), bytes_in(made[k].children));
      files.noise.write(files.node_count * sizeof(float), bytes_in(made[k].noise));
      files.node_count += made[k].nodes.size(), files.child_count += made[k].children.size();
    }
    progress(static_cast<double>(end) / static_cast<double>(forests.size()));
  }
  return forests;
}

}  // namespace insonify
