// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "sampling/choose_projection_internal.hpp"
#include "sampling/direction_raster_internal.hpp"
#include "sampling/list_where_internal.hpp"

namespace insonify {

Projection choose_projection(const GatedSurfels& surfels, Projection wanted, std::size_t queries, int threads) {
  if (wanted != Projection::automatic) return wanted;
  // Measured times [ns]: test of a wide surfel against a direction, drawing of a surfel, insertion into a tree, and
  // search.
  constexpr double wide_test = 2, draw = 120, build = 25, search = 1500;
  const auto n = static_cast<double>(surfels.size()), requested = static_cast<double>(queries);
  const auto wide = static_cast<double>(
      count_where(surfels.size(), threads, [&](std::size_t s) { return DirectionRaster::is_wide(surfels[s]); }));
  const double by_raster = wide * requested * wide_test + n * draw;
  const double by_tree = n * std::log2(n + 2) * build + requested * search;
  return by_raster <= by_tree ? Projection::raster : Projection::kdtree;
}

}  // namespace insonify
