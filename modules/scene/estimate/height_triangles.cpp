// SPDX-License-Identifier: BSD-3-Clause
#include "scene/estimate/height_triangles.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "scene/estimate/surfel_cell_internal.hpp"
#include "scene/scene_index.hpp"

// Each point finds its own triangles. A corner of its Voronoi cell, between two neighbouring sides, is the centre of
// the circle through the point and the two neighbours across; that circle holds no other point. All points that could
// lie in a circle of radius R through a point are within 2 R of it, so a cell is exact as far as neighbours were
// sought. A triangle is listed by its first corner. Where four points lie on a circle, as on a grid, their cells must
// agree: positions are moved by a ten-thousandth of a spacing, by a hash of their index.
namespace insonify {
namespace {

using namespace cells;
using Triangle = std::array<std::uint32_t, 3>;

constexpr std::size_t first_look = 24, most_looked_at = 1024;  // numbers of neighbours
constexpr double widest_circle = 2;                            // largest circumradius, in spacings
constexpr double moved = 1e-4;                                 // jitter, in spacings

double hashed(std::uint64_t n) {  // in [-0.5, 0.5) (splitmix64)
  n = (n + 1) * 0x9e3779b97f4a7c15u;
  n = (n ^ n >> 30) * 0xbf58476d1ce4e5b9u;
  n = (n ^ n >> 27) * 0x94d049bb133111ebu;
  return static_cast<double>((n ^ n >> 31) >> 11) * 0x1p-53 - 0.5;
}

class Stars {
 public:
  explicit Stars(std::vector<Vector3f> flat) : flat_(std::move(flat)), index_(flat_) {
    Vector3f low = flat_[0], high = flat_[0];
    for (const Vector3f& p : flat_) low = low.cwiseMin(p), high = high.cwiseMax(p);
    const double plan = static_cast<double>(high.x() - low.x()) * static_cast<double>(high.y() - low.y());
    const double most = moved * std::sqrt(plan / static_cast<double>(flat_.size()));
    positions_.reserve(flat_.size());
    for (std::size_t i = 0; i < flat_.size(); ++i)
      positions_.emplace_back(flat_[i].x() + most * hashed(2 * i), flat_[i].y() + most * hashed(2 * i + 1));
  }

  /// Appends the triangles whose first corner is point i.
  void add(std::uint32_t i, Workspace& work, std::vector<Triangle>& triangles) const {
    const double widest = find_cell(i, work);
    const Polygon& cell = work.cell;
    for (std::size_t a = 0, b = cell.size() - 1; a < cell.size(); b = a++) {
      // This corner ends the side of one neighbour and begins that of the next.
      if (cell[b].index == no_neighbour || cell[a].index == no_neighbour || cell[a].at.norm() > widest) continue;
      const std::uint32_t j = work.found[cell[b].index].index, k = work.found[cell[a].index].index;
      if (i < j && i < k) triangles.push_back({i, j, k});
    }
  }

 private:
  /// Cuts the cell of a point out of a square that holds the widest circle, by as many neighbours as can change a
  /// corner within it; returns the radius of that circle.
  double find_cell(std::uint32_t i, Workspace& work) const {
    double widest = 0;
    for (std::size_t looked_at = first_look;; looked_at *= 2) {
      index_.find_nearest(flat_[i], looked_at + 1, work.found);
      const double farthest = std::sqrt(static_cast<double>(work.found.back().squared_distance));
      if (looked_at == first_look)
        widest = widest_circle * farthest * std::sqrt(pi / static_cast<double>(work.found.size()));
      clip(i, widest, work);
      const double decided_within = 2 * std::min(widest, reach_of(work.cell));
      if (farthest >= decided_within || work.found.size() <= looked_at || looked_at >= most_looked_at) return widest;
    }
  }

  /// Returns the distance of the farthest corner, with a margin for the jitter.
  static double reach_of(const Polygon& cell) {
    double squared = 0;
    for (const Corner& c : cell) squared = std::max(squared, c.at.squaredNorm());
    return 1.01 * std::sqrt(squared);
  }

  void clip(std::uint32_t i, double widest, Workspace& work) const {
    const double half = 2 * widest;
    work.cell = {{{-half, -half}, no_neighbour},
                 {{half, -half}, no_neighbour},
                 {{half, half}, no_neighbour},
                 {{-half, half}, no_neighbour}};
    double reach = reach_of(work.cell);
    for (std::uint32_t n = 0; n < work.found.size(); ++n) {
      if (static_cast<double>(work.found[n].squared_distance) > 4 * reach * reach) return;
      if (work.found[n].index == i) continue;
      clip_by_bisector(work.cell, positions_[work.found[n].index] - positions_[i], n, work.scratch);
      reach = reach_of(work.cell);
    }
  }

  std::vector<Vector3f> flat_;
  SceneIndex index_;
  std::vector<Vector2d> positions_;
};

}  // namespace

std::vector<Triangle> height_triangles(std::span<const Vector3f> points, int threads) {
  if (points.size() < 3) return {};
  const Stars stars(plan_of(points));
  constexpr std::size_t at_once = 1024;
  std::vector<std::vector<Triangle>> blocks((points.size() + at_once - 1) / at_once);
  parallel_blocks(points.size(), at_once, threads, [&](std::size_t begin, std::size_t end) {
    Workspace work;
    for (std::size_t i = begin; i < end; ++i) stars.add(static_cast<std::uint32_t>(i), work, blocks[begin / at_once]);
  });
  std::vector<Triangle> triangles;
  for (const auto& block : blocks) triangles.insert(triangles.end(), block.begin(), block.end());
  return triangles;
}

}  // namespace insonify
