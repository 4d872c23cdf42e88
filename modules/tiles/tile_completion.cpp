// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include <Eigen/Core>

#include "core/units.hpp"
#include "tiles/tile_completion_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr std::size_t tiles_at_once = 128;  // full ones; their surfels are completed together
constexpr double halo_spacings = 12;        // on a plane the 128 nearest neighbours lie within 6.4, 17 within 2.4
constexpr double widest_halo = 4;  // over the median of a group, so that a few strays do not call for all others

using TileNumbers = std::span<std::size_t>;

// Divides tiles at the medians of their widest extents until each group holds at most `most` surfels, or is one tile.
void divide_tiles(const std::vector<TileEntry>& tiles, TileNumbers numbers, std::size_t most,
                  std::vector<TileNumbers>& groups) {
  std::size_t surfels = 0;
  Bounds box;
  for (const std::size_t t : numbers) {
    const Vector3d centre = vector_in(tiles[t].centre);
    box = {box.min.cwiseMin(centre), box.max.cwiseMax(centre)};
    surfels += tiles[t].count;
  }
  if (surfels <= most || numbers.size() == 1) return groups.push_back(numbers);
  Eigen::Index axis = 0;
  (box.max - box.min).maxCoeff(&axis);
  const std::size_t half = numbers.size() / 2;
  std::nth_element(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(half), numbers.end(),
                   [&](std::size_t a, std::size_t b) {
                     const double left = tiles[a].centre[axis], right = tiles[b].centre[axis];
                     return left == right ? a < b : left < right;
                   });
  divide_tiles(tiles, numbers.first(half), most, groups);
  divide_tiles(tiles, numbers.subspan(half), most, groups);
}

// Returns the distance [m] from a group within which surfels decide about its own. The spacing at a tile is that of the
// surfels of all tiles in its bounding sphere, if they filled its disc.
double halo_of(const std::vector<TileEntry>& tiles, TileNumbers group) {
  std::vector<std::pair<double, std::size_t>> halos;  // with the numbers of surfels
  std::size_t surfels = 0, below = 0;
  for (const std::size_t t : group) {
    const Vector3d centre = vector_in(tiles[t].centre);
    const double radius = tiles[t].radius;
    std::size_t there = 0;
    for (const std::size_t other : group)
      if ((vector_in(tiles[other].centre) - centre).norm() <= radius) there += tiles[other].count;
    halos.emplace_back(halo_spacings * radius * std::sqrt(pi / static_cast<double>(there)), tiles[t].count);
    surfels += tiles[t].count;
  }
  std::sort(halos.begin(), halos.end());
  for (const auto& [halo, count] : halos)
    if (2 * (below += count) >= surfels) return std::min(halos.back().first, widest_halo * halo);
  return 0;
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

// Appends the surfels of other tiles that lie in the halo of a group, whose own are in `all`.
void append_halo(const ColumnFile& columns, const std::vector<TileEntry>& tiles, TileNumbers group,
                 const Vector3d& middle, SceneCloud& all) {
  std::vector<bool> inside(tiles.size());
  for (const std::size_t t : group) inside[t] = true;
  Bounds box;
  for (const auto& p : all.point) {
    const Vector3d at = middle + p.cast<double>();
    box = {box.min.cwiseMin(at), box.max.cwiseMax(at)};
  }
  const double halo = halo_of(tiles, group);
  const auto distance = [&](const Vector3d& from) { return (from.cwiseMax(box.min).cwiseMin(box.max) - from).norm(); };
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    if (inside[t] || distance(vector_in(tiles[t].centre)) > halo + tiles[t].radius) continue;
    std::size_t kept = all.size();
    append(columns, tiles[t], middle, all);
    for (std::size_t i = kept; i < all.size(); ++i)
      if (distance(middle + all.point[i].cast<double>()) <= halo) move_surfel(all, i, kept++);
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
  std::vector<std::size_t> numbers(tiles.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  std::vector<TileNumbers> groups;
  if (!tiles.empty()) divide_tiles(tiles, numbers, tiles_at_once * options.tile_surfels, groups);
  double total = 0, done = 0;
  for (const TileNumbers group : groups) {
    std::sort(group.begin(), group.end());
    const Vector3d middle = vector_in(tiles[group.front()].reference);
    SceneCloud all;
    all.origin = options.origin + middle;
    for (const std::size_t t : group) append(columns, tiles[t], middle, all);
    const std::size_t inside = all.size();
    append_halo(columns, tiles, group, middle, all);
    options.complete(all);
    total = std::accumulate(all.area.begin(), all.area.begin() + static_cast<std::ptrdiff_t>(inside), total);
    std::size_t first = 0;
    for (const std::size_t t : group) write_tile(columns, all, first, tiles[t]), first += tiles[t].count;
    progress((done += 1) / static_cast<double>(groups.size()));
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
