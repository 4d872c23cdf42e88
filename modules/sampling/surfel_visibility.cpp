// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string_view>
#include <unordered_set>
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
// decision is always that of `cover` and `hides`, so both methods and all thread counts give the same bytes. Of surfels
// that coincide, as where a part of a scene stands many times in one position, one hides for all.
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
// plane_distance / g(x, y) with g linear, and occluded points are deeper than
// (plane_distance + unevenness + 3 noise) / g. Stores the inverse of that bound, slightly enlarged for rounding.
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

// The inverse of the least hiding depth in each cell of a row of a tile: its value at the centre of the cell plus half
// a cell along the gradient.
struct LeastDepth {
  float row, step;

  LeastDepth(const HidingDepth& depth, const DirectionTile& tile, std::size_t y) : step(depth.along_x * tile.cell_x) {
    const float step_y = depth.along_y * tile.cell_y, most = 0.5f * (std::abs(step) + std::abs(step_y));
    const float corner = depth.constant + most + depth.along_x * tile.x + 0.5f * step;
    row = corner + depth.along_y * tile.y + step_y * (static_cast<float>(y) + 0.5f);
  }
  float inverse_at(std::size_t x) const { return row + step * static_cast<float>(x); }
};

// Depth buffer of one tile: for each cell the inverse of the least depth at which a surfel may be hidden. Surfels in
// front of it are visible; only those behind it are tested one by one.
class DepthTile {
 public:
  DepthTile(const GatedSurfels& surfels, std::span<const std::uint32_t> queried, std::span<const CubePoint> queries)
      : surfels_(surfels), queried_(queried), queries_(queries) {}

  void find_covers(const DirectionTile& tile, std::vector<Cover>& covers) {
    nearest_.fill(0);
    depths_.clear();
    for (const TileBox& box : tile.boxes) draw(tile, box, depths_.emplace_back(surfels_, box.surfel, tile.face));
    sort_open(tile);
    if (open_.empty()) return;
    for (std::size_t b = 0; b < tile.boxes.size(); ++b) {
      const TileBox& box = tile.boxes[b];
      const HidingDepth& depth = depths_[b];
      for (std::size_t y = box.y0; y <= box.y1; ++y) {
        // Between the first and the last cell with a query that is deep enough.
        const auto [x0, x1] = reached_cells(LeastDepth(depth, tile, y), y, box);
        if (x0 > x1) continue;
        // Collects the queries of this row that are behind: they stand side by side, and few of them are.
        std::size_t found = 0;
        for (std::uint32_t i = first_[y * side + x0]; i < first_[y * side + x1 + 1]; ++i) {
          behind_[found] = i;
          found += depth.before(positions_[i]);
        }
        for (std::size_t k = 0; k < found; ++k) {
          Open& behind = open_[behind_[k]];
          if (hides(behind.so_far)) continue;
          behind.so_far |= cover(surfels_, box.surfel, behind.line);
          hidden_ += hides(behind.so_far);
        }
      }
      if (2 * hidden_ > open_.size()) drop_hidden(covers);
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
  static_assert(side == 64, "a bit for each cell of a row");

  /// Returns the first and the last cell of a box's row with a query that is deep enough; the first beyond the last:
  /// none.
  std::pair<std::size_t, std::size_t> reached_cells(const LeastDepth& least, std::size_t y, const TileBox& box) const {
    const float* const deepest = deepest_.data() + y * side;
    std::uint64_t cells = queried_in_[y] & (~std::uint64_t{0} >> (side - 1 - box.x1)) & (~std::uint64_t{0} << box.x0);
    const auto first = [&] { return static_cast<std::size_t>(std::countr_zero(cells)); };
    const auto last = [&] { return static_cast<std::size_t>(std::bit_width(cells)) - 1; };
    const auto reached = [&](std::size_t x) { return least.inverse_at(x) * deepest[x] >= 1; };
    while (cells != 0 && !reached(first())) cells &= cells - 1;
    while (cells != 0 && !reached(last())) cells &= ~std::bit_floor(cells);
    return cells == 0 ? std::pair<std::size_t, std::size_t>(1, 0) : std::pair(first(), last());
  }

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
    deepest_.fill(0);
    queried_in_.fill(0);
    std::exclusive_scan(first_.begin(), first_.end(), first_.begin(), 0U);
    std::vector<std::uint32_t> sorted(found.size());
    for (const auto& [cell, query] : found) {
      sorted[first_[cell]++] = query;
      queried_in_[cell / side] |= std::uint64_t{1} << cell % side;
      deepest_[cell] = std::max(deepest_[cell], queries_[query].depth);
    }
    std::shift_right(first_.begin(), first_.end(), 1);
    first_[0] = 0;
    for (const std::uint32_t query : sorted) {
      positions_.push_back(queries_[query]);
      open_.push_back({LineOfSight(surfels_[queried_[query]]), queried_[query], 0});
    }
    behind_.resize(open_.size() + 1);
  }

  /// Takes those that are hidden off the list, in which each other box would meet them.
  void drop_hidden(std::vector<Cover>& covers) {
    std::uint32_t kept = 0;
    for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell) {
      deepest_[cell] = 0;
      for (std::uint32_t i = std::exchange(first_[cell], kept); i < first_[cell + 1]; ++i) {
        if (hides(open_[i].so_far)) {
          covers[open_[i].surfel] = open_[i].so_far;
          continue;
        }
        deepest_[cell] = std::max(deepest_[cell], positions_[i].depth);
        open_[kept] = open_[i], positions_[kept++] = positions_[i];
      }
      if (first_[cell] == kept) queried_in_[cell / side] &= ~(std::uint64_t{1} << cell % side);
    }
    first_.back() = kept, hidden_ = 0;
    open_.erase(open_.begin() + kept, open_.end());
    positions_.resize(kept);
  }

  void draw(const DirectionTile& tile, const TileBox& box, const HidingDepth& depth) {
    for (std::size_t y = box.y0; y <= box.y1; ++y) {
      const LeastDepth least(depth, tile, y);
      float* const cells = nearest_.data() + y * side;
      for (std::size_t x = box.x0; x <= box.x1; ++x) cells[x] = std::max(cells[x], least.inverse_at(x));
    }
  }

  const GatedSurfels& surfels_;
  std::span<const std::uint32_t> queried_;
  std::span<const CubePoint> queries_;
  std::array<float, side * side> nearest_, deepest_;  // inverse depth of occluders; depth of those open
  std::array<std::uint64_t, side> queried_in_;        // bits of cells with open queries, by rows
  std::vector<HidingDepth> depths_;                   // of the boxes
  std::vector<Open> open_;                            // by cells
  std::vector<CubePoint> positions_;                  // of these
  std::array<std::uint32_t, side * side + 1> first_;  // of each cell
  std::vector<std::uint32_t> behind_;
  std::size_t hidden_ = 0;  // of those open
};

std::vector<Cover> covers_by_raster(const GatedSurfels& surfels, int threads) {
  const auto queried =
      list_where(surfels.size(), threads, [&](std::size_t s) { return surfels[s].in_gate && surfels[s].facing; });
  UninitializedVector<CubePoint> queries(queried.size());
  parallel_blocks(queried.size(), 1 << 14, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) queries[k] = on_cube(surfels[queried[k]].position);
  });
  const DirectionRaster raster(surfels, queries, Footprint::disc, threads);
  std::vector<Cover> covers(surfels.size(), 0);
  parallel_for(raster.tiles(), threads, [&](std::size_t t) {
    const DirectionTile tile = raster.tile(t);
    if (!tile.queries.empty()) DepthTile(surfels, queried, queries).find_covers(tile, covers);
  });
  if (!raster.wide().empty())
    parallel_blocks(queried.size(), 2048, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        for (const std::uint32_t w : raster.wide())
          if (!hides(covers[queried[k]])) covers[queried[k]] |= cover(surfels, w, LineOfSight(surfels[queried[k]]));
    });
  return covers;
}

std::vector<std::uint8_t> find_hidden_of(const GatedSurfels& surfels, Projection projection, int threads) {
  const std::vector<Cover> covers =
      projection == Projection::raster
          ? covers_by_raster(surfels, threads)
          : covers_by_index(surfels, DirectionIndex(surfels, projection, hiding_reach, threads), threads);
  std::vector<std::uint8_t> hidden(surfels.size());
  std::transform(covers.begin(), covers.end(), hidden.begin(), [](Cover c) { return hides(c); });
  return hidden;
}

// The bytes of a surfel as an occluder: its numbers up to the noise, and those of its facet.
struct OccluderBytes {
  std::string_view disc, facet;

  OccluderBytes(const GatedSurfels& surfels, std::size_t s)
      : disc(reinterpret_cast<const char*>(&surfels[s]), offsetof(GatedSurfel, surfel)) {
    if (!surfels.facet.empty()) facet = {reinterpret_cast<const char*>(&surfels.facet[s]), sizeof(GatedFacet)};
  }
  bool operator==(const OccluderBytes&) const = default;
  std::size_t hash() const {
    const std::hash<std::string_view> of;
    return of(disc) ^ (facet.empty() ? 0 : 3 * of(facet));
  }
};

// True if two coincide of as many surfels as find nearly every scene in which so many coincide that tests take long.
// They are taken from all over the list.
bool some_coincide(const GatedSurfels& surfels) {
  constexpr std::size_t samples = 1024, few = 8 * samples, steps = 0x9e3779b97f4a7c15;
  if (surfels.size() < few) return false;
  std::vector<std::pair<std::size_t, std::size_t>> hashes;  // and the surfel
  for (std::size_t k = 0; k < samples; ++k) {
    const std::size_t s = k * steps % surfels.size();
    hashes.emplace_back(OccluderBytes(surfels, s).hash(), s);
  }
  std::ranges::sort(hashes);
  return std::ranges::adjacent_find(hashes, [](const auto& a, const auto& b) {
           return a.first == b.first && a.second != b.second;
         }) != hashes.end();
}

// The surfels, of which those that coincide with one before them hide nothing.
GatedSurfels with_one_occluder_each(const GatedSurfels& surfels) {
  const auto hash = [&](std::uint32_t s) { return OccluderBytes(surfels, s).hash(); };
  const auto same = [&](std::uint32_t a, std::uint32_t b) {
    return OccluderBytes(surfels, a) == OccluderBytes(surfels, b);
  };
  std::unordered_set<std::uint32_t, decltype(hash), decltype(same)> first(surfels.size(), hash, same);
  GatedSurfels thinned = surfels;
  for (std::uint32_t s = 0; s < surfels.size(); ++s)
    if (!first.insert(s).second) thinned[s].radius = 0;
  return thinned;
}

}  // namespace

std::vector<std::uint8_t> find_hidden(const GatedSurfels& surfels, Projection projection, int threads) {
  if (some_coincide(surfels)) return find_hidden_of(with_one_occluder_each(surfels), projection, threads);
  return find_hidden_of(surfels, projection, threads);
}

}  // namespace insonify
