// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include <Eigen/Core>

#include "core/units.hpp"
#include "scene/estimate/surfel_area.hpp"
#include "scene_io/tile_areas_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d, Eigen::Vector3f;

constexpr std::size_t tiles_at_once = 32;
constexpr double halo_spacings = 10;  // the 64 nearest neighbours on a plane lie within 5

Vector3d centre_of(const TileEntry& tile) { return Eigen::Map<const Vector3d>(tile.centre); }

// Largest distance to neighbours of a tile's surfels, from their spacing if they filled the disc of the bounding
// sphere.
double halo_of(const TileEntry& tile) {
  return halo_spacings * tile.radius * std::sqrt(pi / static_cast<double>(tile.count));
}

struct Points {
  std::vector<Vector3f> point, normal;
};

// Appends a tile's points relative to `middle`.
void append(const BinaryFile& file, const TileEntry& tile, const Vector3d& middle, Points& all) {
  const std::size_t first = all.point.size(), n = tile.count;
  all.point.resize(first + n);
  all.normal.resize(first + n);
  file.read(tile.offset, {reinterpret_cast<char*>(all.point.data() + first), 12 * n});
  file.read(tile.offset + normals_at * n, {reinterpret_cast<char*>(all.normal.data() + first), 12 * n});
  const Vector3d offset = Eigen::Map<const Vector3d>(tile.reference) - middle;
  if (offset.isZero(0)) return;
  for (std::size_t i = first; i < first + n; ++i) all.point[i] = (all.point[i].cast<double>() + offset).cast<float>();
}

// Appends the tiles outside [begin, end) that intersect the halo of those inside.
void append_halo(const BinaryFile& file, const std::vector<TileEntry>& tiles, std::size_t begin, std::size_t end,
                 const Vector3d& middle, Points& all) {
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    if (t >= begin && t < end) continue;
    const bool near = std::any_of(tiles.begin() + static_cast<std::ptrdiff_t>(begin),
                                  tiles.begin() + static_cast<std::ptrdiff_t>(end), [&](const TileEntry& mine) {
                                    const double reach = mine.radius + halo_of(mine) + tiles[t].radius;
                                    return (centre_of(mine) - centre_of(tiles[t])).squaredNorm() <= reach * reach;
                                  });
    if (near) append(file, tiles[t], middle, all);
  }
}

// Writes areas to the file and updates `tile`.
void write_areas(BinaryFile& file, std::span<const float> areas, TileEntry& tile) {
  std::vector<char> bytes(tile.count * surfel_bytes);
  file.read(tile.offset, bytes);
  std::memcpy(bytes.data() + areas_at * tile.count, areas.data(), areas.size_bytes());
  file.write(tile.offset, bytes);
  tile.checksum = checksum(bytes);
  tile.largest_area = *std::max_element(areas.begin(), areas.end());
}

}  // namespace

double fill_areas(BinaryFile& file, std::vector<TileEntry>& tiles, const TileWriterOptions& options,
                  const std::function<void(double)>& progress) {
  double total = 0;
  for (std::size_t begin = 0; begin < tiles.size(); begin += tiles_at_once) {
    const std::size_t end = std::min(tiles.size(), begin + tiles_at_once);
    const Vector3d middle = Eigen::Map<const Vector3d>(tiles[begin].reference);
    Points all;
    for (std::size_t t = begin; t < end; ++t) append(file, tiles[t], middle, all);
    append_halo(file, tiles, begin, end, middle, all);
    const std::vector<float> areas = estimate_surfel_areas(all.point, all.normal, {.threads = options.threads});
    std::size_t first = 0;
    for (std::size_t t = begin; t < end; first += tiles[t++].count) {
      const std::span<const float> mine(areas.data() + first, tiles[t].count);
      write_areas(file, mine, tiles[t]);
      total = std::accumulate(mine.begin(), mine.end(), total);
    }
    progress(static_cast<double>(end) / static_cast<double>(tiles.size()));
  }
  return total;
}

double sum_of_areas(const BinaryFile& file, const std::vector<TileEntry>& tiles) {
  double total = 0;
  for (const TileEntry& tile : tiles) {
    std::vector<float> areas(tile.count);
    file.read(tile.offset + areas_at * tile.count, bytes_in(areas));
    total = std::accumulate(areas.begin(), areas.end(), total);
  }
  return total;
}

}  // namespace insonify
