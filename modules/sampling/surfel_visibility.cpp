// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "sampling/direction_index_internal.hpp"
#include "sampling/direction_raster_internal.hpp"
#include "sampling/hit_rule_internal.hpp"
#include "sampling/list_where_internal.hpp"
#include "sampling/surfel_visibility_internal.hpp"

// Finds the surfels hidden behind others (E16): collects the sectors around each line of sight that nearer surfels
// cover, in a bit mask, by one of two equivalent methods:
//   KD-trees: for each surfel query the surfels whose footprint contains its direction, and apply `cover` to each;
//   raster:   1. project the queried centres onto the faces of a cube and bin them into tiles of cells;
//             2. per tile, rasterise the footprints into a depth buffer, as in z-buffering of splats: for each cell the
//                inverse of the least depth at which a surfel may be hidden, rounded to the safe side;
//             3. surfels in front of the buffer are visible; apply `cover` to the others with each footprint that
//                overlaps their cell; wide surfels are tested against all.
// Cost: O(n log n) by KD-trees, O(n x cells per footprint) by the raster; parallel over surfels or tiles. The exact
// decision is always that of `cover` and `hides`, so both methods and all thread counts give the same bytes.
namespace insonify {
namespace {

// Queries the KD-trees for each surfel.
std::vector<Cover> covers_by_index(const GatedSurfels& surfels, const DirectionIndex& index, int threads) {
  std::vector<Cover> covers(surfels.size(), 0);
  parallel_blocks(surfels.size(), 2048, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> scratch;
    for (std::size_t i = begin; i < end; ++i) {
      const GatedSurfel& s = surfels[i];
      if (!s.in_gate || !s.facing) continue;
      // A surfel cannot hide itself: it does not lie below its own tangent plane.
      const LineOfSight line(s);
      index.any(line.along, s.range, scratch, [&](std::uint32_t other) {
        covers[i] |= cover(surfels, other, line);
        return hides(covers[i]);
      });
    }
  });
  return covers;
}

// Depth beyond which a surfel may occlude. In the coordinates of a cube face its tangent plane is at depth
// plane_distance / g(x, y) with g linear, and occluded points are deeper than (plane_distance + unevenness + 3 noise) / g.
// Stores the inverse of that bound, slightly enlarged for rounding.
struct HidingDepth {
  float constant, along_x, along_y;  // inverse depth and its slopes [1/m]

  HidingDepth(const GatedSurfels& surfels, std::uint32_t surfel, std::uint32_t face) {
    constexpr float rounding = 1 + 1e-5f, slack = 2e-6f;
    const int k = static_cast<int>(face / 2);
    const GatedSurfel& s = surfels[surfel];
    const GatedFacet* const facet = surfels.facet.empty() ? nullptr : &surfels.facet[surfel];
    const Eigen::Vector3f& away = facet ? facet->away : s.away;
    const float beyond =
        facet ? facet->plane_distance + facet->tolerance : s.plane_distance + s.unevenness + 3 * s.noise;
    const float scale = beyond > 0 ? rounding / beyond : 0;
    constant = ((face % 2 == 0 ? away[k] : -away[k]) + slack) * scale;
    along_x = away[(k + 1) % 3] * scale;
    along_y = away[(k + 2) % 3] * scale;
  }
  bool before(const CubePoint& q) const { return q.depth * (constant + along_x * q.x + along_y * q.y) >= 1; }
};

// Depth buffer of one tile: for each cell the inverse of the least depth at which a surfel may be hidden. Surfels in
// front of it are visible; only those behind it are tested one by one.
class DepthTile {
 public:
  DepthTile(const GatedSurfels& surfels, std::span<const std::uint32_t> asked, std::span<const CubePoint> queries)
      : surfels_(surfels), asked_(asked), queries_(queries) {}

  void find_covers(const DirectionTile& tile, std::vector<Cover>& covers) {
    nearest_.fill(0);
    for (const TileBox& box : tile.boxes) draw(tile, box);
    sort_open(tile);
    if (open_.empty()) return;
    for (const TileBox& box : tile.boxes) {
      const HidingDepth depth(surfels_, box.surfel, tile.face);
      for (std::size_t y = box.y0; y <= box.y1; ++y) {
        // Those of a row stand side by side; few of them are behind.
        std::size_t found = 0;
        for (std::uint32_t i = first_[y * side + box.x0]; i < first_[y * side + box.x1 + 1]; ++i) {
          behind_[found] = i;
          found += depth.before(places_[i]);
        }
        for (std::size_t k = 0; k < found; ++k) {
          Open& behind = open_[behind_[k]];
          if (!hides(behind.so_far)) behind.so_far |= cover(surfels_, box.surfel, behind.line);
        }
      }
    }
    for (const Open& o : open_) covers[o.surfel] = o.so_far;
  }

 private:
  struct Open {
    LineOfSight line;
    std::uint32_t surfel;
    Cover so_far;
  };
  static constexpr std::size_t side = DirectionTile::side;

  /// Lists the queries behind the buffer, by counting sort cell by cell.
  void sort_open(const DirectionTile& tile) {
    std::vector<std::pair<std::size_t, std::uint32_t>> found;  // cell, query
    first_.fill(0);
    for (const std::uint32_t query : tile.queries) {
      const std::size_t cell = tile.cell_of(queries_[query]);
      if (!(queries_[query].depth * nearest_[cell] >= 1)) continue;
      found.emplace_back(cell, query);
      ++first_[cell];
    }
    std::exclusive_scan(first_.begin(), first_.end(), first_.begin(), 0U);
    std::vector<std::uint32_t> sorted(found.size());
    for (const auto& [cell, query] : found) sorted[first_[cell]++] = query;
    std::shift_right(first_.begin(), first_.end(), 1);
    first_[0] = 0;
    for (const std::uint32_t query : sorted) {
      places_.push_back(queries_[query]);
      open_.push_back({LineOfSight(surfels_[asked_[query]]), asked_[query], 0});
    }
    behind_.resize(open_.size() + 1);
  }

  void draw(const DirectionTile& tile, const TileBox& box) {
    const HidingDepth depth(surfels_, box.surfel, tile.face);
    // Maximum over a cell: the value at its centre plus half a cell along the gradient.
    const float step = depth.along_x * tile.cell_x, step_y = depth.along_y * tile.cell_y;
    const float most = 0.5f * (std::abs(step) + std::abs(step_y));
    const float corner = depth.constant + most + depth.along_x * tile.x + 0.5f * step;
    for (std::size_t y = box.y0; y <= box.y1; ++y) {
      const float row = corner + depth.along_y * tile.y + step_y * (static_cast<float>(y) + 0.5f);
      float* const cells = nearest_.data() + y * side;
      for (int x = box.x0; x <= box.x1; ++x) cells[x] = std::max(cells[x], row + step * static_cast<float>(x));
    }
  }

  const GatedSurfels& surfels_;
  std::span<const std::uint32_t> asked_;
  std::span<const CubePoint> queries_;
  std::array<float, side * side> nearest_;
  std::vector<Open> open_;                            // by cells
  std::vector<CubePoint> places_;                     // of these
  std::array<std::uint32_t, side * side + 1> first_;  // of each cell
  std::vector<std::uint32_t> behind_;
};

std::vector<Cover> covers_by_raster(const GatedSurfels& surfels, int threads) {
  const auto asked =
      list_where(surfels.size(), threads, [&](std::size_t s) { return surfels[s].in_gate && surfels[s].facing; });
  UninitializedVector<CubePoint> queries(asked.size());
  parallel_blocks(asked.size(), 1 << 14, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) queries[k] = on_cube(surfels[asked[k]].position);
  });
  const DirectionRaster raster(surfels, queries, Footprint::disc, threads);
  std::vector<Cover> covers(surfels.size(), 0);
  parallel_for(raster.tiles(), threads, [&](std::size_t t) {
    const DirectionTile tile = raster.tile(t);
    if (!tile.queries.empty()) DepthTile(surfels, asked, queries).find_covers(tile, covers);
  });
  if (!raster.wide().empty())
    parallel_blocks(asked.size(), 2048, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        for (const std::uint32_t w : raster.wide())
          if (!hides(covers[asked[k]])) covers[asked[k]] |= cover(surfels, w, LineOfSight(surfels[asked[k]]));
    });
  return covers;
}

}  // namespace

std::vector<std::uint8_t> find_hidden(const GatedSurfels& surfels, Projection projection, int threads) {
  const std::vector<Cover> covers =
      projection == Projection::raster
          ? covers_by_raster(surfels, threads)
          : covers_by_index(surfels, DirectionIndex(surfels, projection, hiding_reach, threads), threads);
  std::vector<std::uint8_t> hidden(surfels.size());
  std::transform(covers.begin(), covers.end(), hidden.begin(), [](Cover c) { return hides(c); });
  return hidden;
}

}  // namespace insonify
