// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "core/units.hpp"
#include "scene/estimate/surfel_area.hpp"
#include "scene/scene_index.hpp"

// Private to scene: the cell of a point among its neighbours (E15).
namespace insonify::cells {

using Eigen::Vector2d, Eigen::Vector3d, Eigen::Vector3f;

inline constexpr double border_gap = radians(120);  // wider gaps between neighbours are borders
inline constexpr double isolation = 4;              // distance of an outlier, in spacings of its nearest point
inline constexpr double largest_spacing = 16;       // largest width of a cell, in median spacings of the cloud
inline constexpr double same_sheet = 1;             // steepest rise of a neighbour over the tangent plane
inline constexpr double same_rough_sheet = 3;       // the same over the base plane of a rough surface

// Returns the points with z = 0.
inline std::vector<Vector3f> plan_of(std::span<const Vector3f> points) {
  std::vector<Vector3f> flat;
  flat.reserve(points.size());
  for (const Vector3f& p : points) flat.emplace_back(p.x(), p.y(), 0.0f);
  return flat;
}

// A neighbour: its position in the tangent plane, and in space relative to the point.
struct FlatNeighbour {
  Vector2d flat;
  Vector3d offset;
};

// A corner of a convex polygon around (0, 0). From it to the next runs the bisector to a neighbour.
struct Corner {
  Vector2d at;
  std::uint32_t index;
};
using Polygon = std::vector<Corner>;
inline constexpr std::uint32_t no_neighbour = ~0u;

inline double area_of(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t a = 0, b = polygon.size() - 1; a < polygon.size(); b = a++)
    twice += polygon[b].at.x() * polygon[a].at.y() - polygon[b].at.y() * polygon[a].at.x();
  return std::abs(twice) / 2;
}

// Keeps the side of the bisector between (0, 0) and `neighbour`, places[place], on which (0, 0) lies.
inline void clip_by_bisector(Polygon& polygon, const Vector2d& neighbour, std::uint32_t index, Polygon& scratch) {
  const double half = neighbour.squaredNorm() / 2;
  scratch.clear();
  for (std::size_t a = 0, b = polygon.size() - 1; a < polygon.size(); b = a++) {
    const double beyond_b = polygon[b].at.dot(neighbour) - half, beyond_a = polygon[a].at.dot(neighbour) - half;
    if ((beyond_a > 0) != (beyond_b > 0)) {
      const Vector2d cut = polygon[b].at + (polygon[a].at - polygon[b].at) * (beyond_b / (beyond_b - beyond_a));
      scratch.push_back({cut, beyond_a > 0 ? index : polygon[b].index});
    }
    if (beyond_a <= 0) scratch.push_back(polygon[a]);
  }
  polygon.swap(scratch);
}

// An interval of directions without neighbours, counter-clockwise from `begin`.
struct Gap {
  double begin = 0, width = 0;
  double middle() const { return begin + width / 2; }
  bool holds(double angle) const {
    return std::remainder(angle - middle(), 2 * pi) * 2 < width && std::remainder(middle() - angle, 2 * pi) * 2 < width;
  }
};

// Everything one thread needs for one point after another.
struct Workspace {
  std::vector<Neighbour> found;
  std::vector<FlatNeighbour> neighbours;  // neighbours, nearest first
  std::vector<double> angle;
  std::vector<Gap> gaps;
  Polygon cell, scratch;
};

class AreaEstimator {
 public:
  AreaEstimator(std::span<const Vector3f> points, int neighbours, double steepest)
      : AreaEstimator(points, points, neighbours, steepest) {}
  // Searches neighbours and forms cells among `charted`: the points projected on a plane, or their directions.
  AreaEstimator(std::span<const Vector3f> charted, std::span<const Vector3f> points, int neighbours, double steepest)
      : charted_(charted),
        points_(points),
        index_(charted),
        neighbours_(static_cast<std::size_t>(neighbours)),
        steepest_(steepest) {}

  double area(std::size_t i, const Vector3f& normal, Workspace& work) const {
    // A neighbourhood that is a line (one scan line of a lidar) is widened until the next lines come into it.
    std::size_t k = neighbours_;
    find_flat_neighbours(i, normal, k, work);
    if (work.gaps.size() > 1) find_flat_neighbours(i, normal, k *= 4, work);
    work.cell.clear();
    if (work.neighbours.empty()) return 0;
    const double nearest = work.neighbours.front().flat.norm();
    if (!work.gaps.empty()) {
      const double spacing_there = spacing_at_nearest(i, work);
      if (nearest > isolation * spacing_there) return spacing_there * spacing_there;
      close_gaps(nearest, work);
    }
    return clipped_area(work);
  }

  // Returns the direction of the facets between the point and the neighbours whose bisectors bound its cell after
  // `area`; zero if there are none.
  static Vector3d facet_normal(const Workspace& work) {
    Vector3d sum = Vector3d::Zero();
    if (work.cell.size() < 3) return sum;
    for (std::size_t a = 0, b = work.cell.size() - 1; a < work.cell.size(); b = a++) {
      const std::uint32_t from = work.cell[b].index, to = work.cell[a].index;
      if (from != no_neighbour && to != no_neighbour)
        sum += work.neighbours[from].offset.cross(work.neighbours[to].offset);
    }
    return sum.norm() > 0 ? Vector3d(sum.normalized()) : Vector3d::Zero();
  }

  const SceneIndex& index() const { return index_; }

 private:
  // Finds the neighbours on the same sheet of surface, in the tangent plane, and the gaps between their directions.
  void find_flat_neighbours(std::size_t i, const Vector3f& normal, std::size_t k, Workspace& work) const {
    const Vector3d n = normal.cast<double>();
    const Vector3d t1 = n.unitOrthogonal(), t2 = n.cross(t1);
    index_.find_nearest(charted_[i], k + 1, work.found);
    work.neighbours.clear();
    for (const Neighbour& neighbour : work.found) {
      if (neighbour.index == i) continue;
      const Vector3d d = (charted_[neighbour.index] - charted_[i]).cast<double>();
      const Vector2d flat(t1.dot(d), t2.dot(d));
      if (std::abs(n.dot(d)) <= steepest_ * flat.norm())
        work.neighbours.push_back({flat, (points_[neighbour.index] - points_[i]).cast<double>()});
    }
    find_gaps(work);
  }

  // Returns true if each sixth of all directions holds a neighbour: then no gap is wider than two sixths.
  static bool surrounded(const Workspace& work) {
    unsigned held = 0;
    for (const FlatNeighbour& p : work.neighbours) {
      const double y = p.flat.y(), slanted = std::sqrt(3.0) * p.flat.x();
      const int upper = y < slanted ? 0 : y < -slanted ? 2 : 1, lower = y > slanted ? 3 : y > -slanted ? 5 : 4;
      held |= 1u << (y >= 0 ? upper : lower);
      if (held == 63) return true;
    }
    return false;
  }

  static void find_gaps(Workspace& work) {
    work.gaps.clear();
    if (surrounded(work)) return;
    work.angle.clear();
    for (const FlatNeighbour& p : work.neighbours) work.angle.push_back(std::atan2(p.flat.y(), p.flat.x()));
    std::sort(work.angle.begin(), work.angle.end());
    for (std::size_t a = 0; a < work.angle.size(); ++a) {
      const double next = a + 1 < work.angle.size() ? work.angle[a + 1] : work.angle[0] + 2 * pi;
      if (next - work.angle[a] > border_gap) work.gaps.push_back({work.angle[a], next - work.angle[a]});
    }
  }

  // Returns the distance from the nearest neighbour to its own third nearest point.
  double spacing_at_nearest(std::size_t i, Workspace& work) const {
    std::uint32_t nearest = static_cast<std::uint32_t>(i);
    for (auto n = work.found.rbegin(); n != work.found.rend(); ++n)
      if (n->index != i) nearest = n->index;
    index_.find_nearest(charted_[nearest], 4, work.found);
    return std::sqrt(static_cast<double>(work.found.back().squared_distance));
  }

  // Fills borders with mirror images of the neighbours opposite, so that a cell extends as far beyond its point as
  // within. Gaps that stay wider than the limit get points at the distance of the nearest neighbour.
  static void close_gaps(double nearest, Workspace& work) {
    const std::size_t real = work.neighbours.size();
    const std::vector<Gap> gaps = work.gaps;
    for (std::size_t j = 0; j < real; ++j) {
      const FlatNeighbour mirrored = {-work.neighbours[j].flat, -work.neighbours[j].offset};
      const double angle = std::atan2(mirrored.flat.y(), mirrored.flat.x());
      for (const Gap& gap : gaps)
        if (gap.holds(angle)) work.neighbours.push_back(mirrored);
    }
    find_gaps(work);
    for (const Gap& gap : work.gaps) {
      const int parts = static_cast<int>(std::ceil(gap.width / border_gap));
      for (int p = 1; p < parts; ++p) {
        const double angle = gap.begin + gap.width * p / parts;
        const Vector2d flat(nearest * std::cos(angle), nearest * std::sin(angle));
        work.neighbours.push_back({flat, Vector3d::Zero()});
      }
    }
    std::sort(work.neighbours.begin(), work.neighbours.end(), [](const FlatNeighbour& a, const FlatNeighbour& b) {
      return a.flat.squaredNorm() < b.flat.squaredNorm();
    });
  }

  static double clipped_area(Workspace& work) {
    double farthest = 0;
    for (const FlatNeighbour& p : work.neighbours) farthest = std::max(farthest, p.flat.norm());
    work.cell = {{{-farthest, -farthest}, no_neighbour},
                 {{farthest, -farthest}, no_neighbour},
                 {{farthest, farthest}, no_neighbour},
                 {{-farthest, farthest}, no_neighbour}};
    constexpr double rounding = 1 + 1e-9;
    double reach = 2 * farthest * farthest;  // square of the distance of the farthest corner
    for (std::uint32_t p = 0; p < work.neighbours.size(); ++p) {
      if (work.neighbours[p].flat.squaredNorm() > 4 * rounding * reach) continue;  // its bisector is beyond the cell
      clip_by_bisector(work.cell, work.neighbours[p].flat, p, work.scratch);       // (E15)
      reach = 0;
      for (const Corner& corner : work.cell) reach = std::max(reach, corner.at.squaredNorm());
    }
    return work.cell.size() < 3 ? 0 : area_of(work.cell);
  }

  std::span<const Vector3f> charted_, points_;
  SceneIndex index_;
  std::size_t neighbours_;
  double steepest_;  // largest rise of a neighbour over its distance
};

// Limits the areas of outliers, whose discs would hide whole scenes.
inline void limit_cells(std::vector<double>& areas) {
  std::vector<double> sorted = areas;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  if (*middle > 0)
    for (double& a : areas) a = std::min(a, *middle * largest_spacing * largest_spacing);
}

inline void require_valid(std::span<const Vector3f> points, std::span<const Vector3f> normals,
                          const AreaOptions& options, const char* who) {
  if (points.size() != normals.size())
    fail(ErrorKind::argument, who, ": ", normals.size(), " normals for ", points.size(), " points, must be one each");
  if (options.neighbours < 6)
    fail(ErrorKind::argument, who, ": neighbours = ", options.neighbours, ", must be at least 6");
}

}  // namespace insonify::cells
