// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "sampling/depth_tile_internal.hpp"

namespace insonify {
namespace {

constexpr std::uint32_t no_line = ~std::uint32_t{0};

/// More than what single precision changes of a surfel's depth or position [m].
float rounding_of(const GatedSurfel& s) { return 4e-6f * s.range; }

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
};

}  // namespace

void OpenList::fill(std::span<const std::uint32_t> surfels) {
  const std::size_t count = surfels.size();
  entries.resize(count);
  for (auto& numbers : numbers_) numbers.assign(count + kernels::visibility_lanes, 0);
  // Facets hide what is deeper than their own tolerance.
  const bool by_disc = surfels_.facet.empty();
  for (std::size_t i = 0; i < count; ++i) {
    const GatedSurfel& s = surfels_[surfels[i]];
    entries[i] = {surfels[i], 0, no_line};
    numbers_[0][i] = s.position.x(), numbers_[1][i] = s.position.y(), numbers_[2][i] = s.position.z();
    if (by_disc) numbers_[3][i] = s.unevenness, numbers_[4][i] = s.noise;
    numbers_[5][i] = rounding_of(s);
  }
}

void OpenList::take_out(std::size_t entry) {
  for (auto& numbers : numbers_) numbers[entry] = 0;
}

void OpenList::move(std::size_t from, std::size_t to) {
  entries[to] = entries[from];
  for (auto& numbers : numbers_) numbers[to] = numbers[from];
}

void OpenList::keep(std::size_t count) {
  entries.resize(count);
  for (auto& numbers : numbers_) {
    numbers.resize(count);
    numbers.resize(count + kernels::visibility_lanes, 0);
  }
}

const LineOfSight& OpenList::line_to(Entry& entry) {
  if (entry.line == no_line) {
    entry.line = static_cast<std::uint32_t>(lines_.size());
    lines_.emplace_back(surfels_[entry.surfel]);
  }
  return lines_[entry.line];
}

kernels::HidingDisc OpenList::disc_of(std::uint32_t surfel) const {
  constexpr float room = 1.001f;
  const GatedSurfel& s = surfels_[surfel];
  const GatedFacet* const facet = surfels_.facet.empty() ? nullptr : &surfels_.facet[surfel];
  const Eigen::Vector3f& away = facet ? facet->away : s.away;
  return {{away.x(), away.y(), away.z()},
          facet ? facet->plane_distance : s.plane_distance,
          {s.position.x(), s.position.y(), s.position.z()},
          room * (facet ? 1 : hiding_reach) * s.radius + rounding_of(s),
          facet ? facet->tolerance : s.unevenness,
          facet ? 0 : s.noise};
}

kernels::OpenSurfels OpenList::numbers() const {
  const auto& n = numbers_;
  return {n[0].data(), n[1].data(), n[2].data(), n[3].data(), n[4].data(), n[5].data()};
}

void DepthTile::find_covers(const DirectionTile& tile, std::vector<Cover>& covers) {
  nearest_.fill(0);
  for (const TileBox& box : tile.boxes) draw(tile, box);
  sort_open(tile);
  if (open_.entries.empty()) return;
  for (const TileBox& box : tile.boxes) {
    const std::size_t found = list_behind(box);
    for (std::size_t k = 0; k < found; ++k) {
      OpenList::Entry& behind = open_.entries[behind_[k]];
      if (hides(behind.so_far)) continue;
      behind.so_far |= cover(surfels_, box.surfel, open_.line_to(behind));
      if (!hides(behind.so_far)) continue;
      open_.take_out(behind_[k]);
      ++hidden_;
    }
    if (2 * hidden_ > open_.entries.size()) drop_hidden(covers);
  }
  for (const OpenList::Entry& o : open_.entries) covers[o.surfel] = o.so_far;
}

void DepthTile::draw(const DirectionTile& tile, const TileBox& box) {
  // In each cell the value at its centre, and half a cell along the gradient.
  const HidingDepth depth(surfels_, box.surfel, tile.face);
  const float step_x = depth.along_x * tile.cell_x, step_y = depth.along_y * tile.cell_y;
  const float corner = depth.constant + depth.along_x * tile.x + depth.along_y * tile.y,
              most = 0.5f * (std::abs(step_x) + std::abs(step_y));
  const float start =
      corner + most + step_x * (static_cast<float>(box.x0) + 0.5f) + step_y * (static_cast<float>(box.y0) + 0.5f);
  kernels::raise_cells(nearest_.data() + box.y0 * side + box.x0, side, box.x1 - box.x0 + std::size_t{1},
                       box.y1 - box.y0 + std::size_t{1}, {start, step_x, step_y});
}

void DepthTile::sort_open(const DirectionTile& tile) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;  // cell, query
  first_.fill(0);
  for (const std::uint32_t query : tile.queries) {
    const std::size_t cell = tile.cell_of(queries_[query]);
    if (!(queries_[query].depth * nearest_[cell] >= 1)) continue;
    found.emplace_back(static_cast<std::uint32_t>(cell), query);
    ++first_[cell];
  }
  queried_in_.fill(0);
  std::exclusive_scan(first_.begin(), first_.end(), first_.begin(), 0U);
  std::vector<std::uint32_t> sorted(found.size());
  for (const auto& [cell, query] : found) {
    sorted[first_[cell]++] = query;
    queried_in_[cell / side] |= std::uint64_t{1} << cell % side;
  }
  std::shift_right(first_.begin(), first_.end(), 1);
  first_[0] = 0;
  for (std::uint32_t& query : sorted) query = queried_[query];
  open_.fill(sorted);
  behind_.resize(sorted.size() + (side + 1) * kernels::visibility_lanes);
}

std::size_t DepthTile::list_behind(const TileBox& box) {
  std::size_t rows = 0;
  std::array<std::uint32_t, side> first, end;
  for (std::size_t y = box.y0; y <= box.y1; ++y) {
    const std::uint64_t cells =
        queried_in_[y] & (~std::uint64_t{0} >> (side - 1 - box.x1)) & (~std::uint64_t{0} << box.x0);
    if (cells == 0) continue;
    first[rows] = first_[y * side + static_cast<std::size_t>(std::countr_zero(cells))];
    end[rows++] = first_[y * side + static_cast<std::size_t>(std::bit_width(cells))];
  }
  return kernels::list_behind(open_.numbers(), open_.disc_of(box.surfel), first.data(), end.data(), rows,
                              behind_.data());
}

void DepthTile::drop_hidden(std::vector<Cover>& covers) {
  std::uint32_t kept = 0;
  for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell) {
    for (std::uint32_t i = std::exchange(first_[cell], kept); i < first_[cell + 1]; ++i) {
      const OpenList::Entry& entry = open_.entries[i];
      if (hides(entry.so_far))
        covers[entry.surfel] = entry.so_far;
      else
        open_.move(i, kept++);
    }
    if (first_[cell] == kept) queried_in_[cell / side] &= ~(std::uint64_t{1} << cell % side);
  }
  first_.back() = kept, hidden_ = 0;
  open_.keep(kept);
}

}  // namespace insonify
