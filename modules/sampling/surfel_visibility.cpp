// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "sampling/depth_tile_internal.hpp"
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
