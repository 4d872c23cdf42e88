// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Core>

#include "core/units.hpp"
#include "scene/estimate/surfel_area.hpp"
#include "tiles/tile_areas_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr std::size_t tiles_at_once = 32;
constexpr double halo_spacings = 10;  // the 64 nearest neighbours on a plane lie within 5

// Returns the largest distance of a tile's surfels from their neighbours [m], by their spacing if they filled the disc
// of the bounding sphere.
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

// Appends the tiles outside [begin, end) that intersect the halo of those inside.
void append_halo(const ColumnFile& columns, const std::vector<TileEntry>& tiles, std::size_t begin, std::size_t end,
                 const Vector3d& middle, SceneCloud& all) {
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    if (t >= begin && t < end) continue;
    const bool near =
        std::any_of(tiles.begin() + static_cast<std::ptrdiff_t>(begin),
                    tiles.begin() + static_cast<std::ptrdiff_t>(end), [&](const TileEntry& mine) {
                      const double reach = mine.radius + halo_of(mine) + tiles[t].radius;
                      return (vector_in(mine.centre) - vector_in(tiles[t].centre)).squaredNorm() <= reach * reach;
                    });
    if (near) append(columns, tiles[t], middle, all);
  }
}

void write_areas(ColumnFile& columns, std::span<const float> areas, TileEntry& tile) {
  SceneCloud rows;
  resize(rows, tile.count, columns.noisy());
  columns.read(tile.first, rows_of(rows, 0, tile.count));
  rows.area.assign(areas.begin(), areas.end());
  columns.write(tile.first, rows_of(rows, 0, tile.count));
  tile.checksum = checksum_of(rows_of(rows, 0, tile.count));
  tile.largest_area = *std::max_element(areas.begin(), areas.end());
}

}  // namespace

double fill_areas(ColumnFile& columns, std::vector<TileEntry>& tiles, const TileWriterOptions& options,
                  const std::function<void(double)>& progress) {
  double total = 0;
  for (std::size_t begin = 0; begin < tiles.size(); begin += tiles_at_once) {
    const std::size_t end = std::min(tiles.size(), begin + tiles_at_once);
    const Vector3d middle = vector_in(tiles[begin].reference);
    SceneCloud all;
    for (std::size_t t = begin; t < end; ++t) append(columns, tiles[t], middle, all);
    append_halo(columns, tiles, begin, end, middle, all);
    const std::vector<float> areas = estimate_surfel_areas(all.point, all.normal, {.threads = options.threads});
    std::size_t first = 0;
    for (std::size_t t = begin; t < end; first += tiles[t++].count) {
      const std::span<const float> mine(areas.data() + first, tiles[t].count);
      write_areas(columns, mine, tiles[t]);
      total = std::accumulate(mine.begin(), mine.end(), total);
    }
    progress(static_cast<double>(end) / static_cast<double>(tiles.size()));
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
