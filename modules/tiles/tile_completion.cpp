// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Core>

#include "core/units.hpp"
#include "tiles/tile_completion_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr std::size_t tiles_at_once = 128;  // full ones; their surfels are completed together
constexpr double halo_spacings = 12;        // on a plane the 128 nearest neighbours lie within 6.4, 17 within 2.4

// Returns the distance [m] from a tile within which surfels decide about its own, by their spacing if they filled the
// disc of the bounding sphere.
double halo_of(const TileEntry& tile) {
  return halo_spacings * tile.radius * std::sqrt(pi / static_cast<double>(tile.count));
}

// Appends the surfels of a tile relative to `middle`.
void append(const ColumnFile& columns, const TileEntry& tile, const Vector3d& middle, SceneCloud& all) {
  const std::size_t first = all.size();
  resize(all, first + tile.count, columns.noisy());
  columns.read(tile.first, rows_of(all, first, tile.count));
  const Vector3d offset = vector_in(tile.reference) - middle;
  if (offset.isZero(0)) return;
  for (std::size_t i = first; i < all.size(); ++i) all.point[i] = (all.point[i].cast<double>() + offset).cast<float>();
}

void move_surfel(SceneCloud& all, std::size_t from, std::size_t to) {
  all.point[to] = all.point[from], all.normal[to] = all.normal[from], all.area[to] = all.area[from];
  all.id[to] = all.id[from], all.material[to] = all.material[from];
  if (!all.noise.empty()) all.noise[to] = all.noise[from];
}

// A run of tiles that are completed together.
struct TileGroup {
  std::size_t begin = 0, end = 0;
  Vector3d middle;
  double halo = 0;  // [m]
  Bounds box;       // of the spheres of the tiles
};

TileGroup next_group(const std::vector<TileEntry>& tiles, std::size_t begin, std::size_t most) {
  TileGroup group{begin, begin, vector_in(tiles[begin].reference), 0, {}};
  for (std::size_t rows = 0; group.end < tiles.size() && (rows == 0 || rows + tiles[group.end].count <= most);) {
    const TileEntry& tile = tiles[group.end++];
    const Vector3d centre = vector_in(tile.centre), reach = Vector3d::Constant(double{tile.radius});
    group.box = {group.box.min.cwiseMin(centre - reach), group.box.max.cwiseMax(centre + reach)};
    group.halo = std::max(group.halo, halo_of(tile));
    rows += tile.count;
  }
  return group;
}

// Appends the surfels outside a group that lie in its halo, of tiles that intersect that of a tile inside.
void append_halo(const ColumnFile& columns, const std::vector<TileEntry>& tiles, const TileGroup& group,
                 SceneCloud& all) {
  const auto inside = [&](std::size_t t) { return t >= group.begin && t < group.end; };
  const auto distance = [&](const Vector3d& from) {
    return (from.cwiseMax(group.box.min).cwiseMin(group.box.max) - from).norm();
  };
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const Vector3d centre = vector_in(tiles[t].centre);
    const double radius = tiles[t].radius;
    if (inside(t) || distance(centre) > group.halo + radius) continue;
    const bool reached =
        std::any_of(tiles.begin() + static_cast<std::ptrdiff_t>(group.begin),
                    tiles.begin() + static_cast<std::ptrdiff_t>(group.end), [&](const TileEntry& mine) {
                      const double reach = mine.radius + halo_of(mine) + radius;
                      return (vector_in(mine.centre) - centre).squaredNorm() <= reach * reach;
                    });
    if (!reached) continue;
    std::size_t kept = all.size();
    append(columns, tiles[t], group.middle, all);
    for (std::size_t i = kept; i < all.size(); ++i)
      if (distance(group.middle + all.point[i].cast<double>()) <= group.halo) move_surfel(all, i, kept++);
    resize(all, kept, columns.noisy());
  }
}

// Writes the normals, areas and noise of a tile, from `first` of the group on.
void write_tile(ColumnFile& columns, const SceneCloud& group, std::size_t first, TileEntry& tile) {
  SceneCloud rows;
  resize(rows, tile.count, columns.noisy());
  columns.read(tile.first, rows_of(rows, 0, tile.count));
  std::copy_n(group.normal.begin() + static_cast<std::ptrdiff_t>(first), tile.count, rows.normal.begin());
  std::copy_n(group.area.begin() + static_cast<std::ptrdiff_t>(first), tile.count, rows.area.begin());
  if (columns.noisy())
    std::copy_n(group.noise.begin() + static_cast<std::ptrdiff_t>(first), tile.count, rows.noise.begin());
  columns.write(tile.first, rows_of(rows, 0, tile.count));
  tile.checksum = checksum_of(rows_of(rows, 0, tile.count));
  tile.largest_area = *std::max_element(rows.area.begin(), rows.area.end());
}

}  // namespace

double complete_tiles(ColumnFile& columns, std::vector<TileEntry>& tiles, const TileWriterOptions& options,
                      const std::function<void(double)>& progress) {
  double total = 0;
  for (std::size_t begin = 0; begin < tiles.size();) {
    const TileGroup group = next_group(tiles, begin, tiles_at_once * options.tile_surfels);
    SceneCloud all;
    all.origin = options.origin + group.middle;
    for (std::size_t t = begin; t < group.end; ++t) append(columns, tiles[t], group.middle, all);
    const std::size_t inside = all.size();
    append_halo(columns, tiles, group, all);
    options.complete(all);
    total = std::accumulate(all.area.begin(), all.area.begin() + static_cast<std::ptrdiff_t>(inside), total);
    std::size_t first = 0;
    for (std::size_t t = begin; t < group.end; first += tiles[t++].count) write_tile(columns, all, first, tiles[t]);
    begin = group.end;
    progress(static_cast<double>(begin) / static_cast<double>(tiles.size()));
  }
  return total;
}

double sum_of_areas(const ColumnFile& columns, const std::vector<TileEntry>& tiles) {
  double total = 0;
  for (const TileEntry& tile : tiles) {
    SceneCloud rows;
    append(columns, tile, vector_in(tile.reference), rows);
    total = std::accumulate(rows.area.begin(), rows.area.end(), total);
  }
  return total;
}

}  // namespace insonify
