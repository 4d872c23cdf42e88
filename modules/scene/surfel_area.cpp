#include "scene/surfel_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "scene/scene_index.hpp"

// Estimates the surface area of each point of a cloud as the area of its Voronoi cell in the tangent plane (E15):
//   1. merge coincident points, build a KD-tree of the distinct ones, find the k nearest of each (k = 16);
//   2. project those on the same sheet (at most 45 degrees off the tangent plane) onto the tangent plane; if they are
//      collinear, as on one scan line, repeat with 4 k neighbours;
//   3. at borders, where the neighbours leave an angular gap above 120 degrees, mirror the opposite neighbours into it;
//      isolated points get the squared spacing of their neighbour instead;
//   4. clip a square by the perpendicular bisectors to all neighbours (half-plane clipping of a convex polygon);
//   5. limit outliers to (16 median spacings)^2 and divide each cell among its coincident points.
// Cost: O(n log n) for the tree and its queries, O(k^2) per point for clipping; parallel over points.
namespace insonify {
namespace {

using Eigen::Vector2d, Eigen::Vector3d, Eigen::Vector3f;

constexpr double border_gap = radians(120);  // wider angular gaps between neighbours are borders
constexpr double isolation = 4;              // an outlier is farther from its nearest point, in spacings at that point
constexpr double largest_spacing = 16;       // limit of a cell's width, in median spacings of the cloud

// A convex polygon with the surfel at (0, 0).
using Polygon = std::vector<Vector2d>;

double area_of(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t a = 0, b = polygon.size() - 1; a < polygon.size(); b = a++)
    twice += polygon[b].x() * polygon[a].y() - polygon[b].y() * polygon[a].x();
  return std::abs(twice) / 2;
}

// Clips the polygon to the side of the bisector between (0, 0) and `neighbour` that contains (0, 0).
void clip_by_bisector(Polygon& polygon, const Vector2d& neighbour, Polygon& scratch) {
  const double half = neighbour.squaredNorm() / 2;
  scratch.clear();
  for (std::size_t a = 0, b = polygon.size() - 1; a < polygon.size(); b = a++) {
    const double beyond_b = polygon[b].dot(neighbour) - half, beyond_a = polygon[a].dot(neighbour) - half;
    if ((beyond_a > 0) != (beyond_b > 0))
      scratch.push_back(polygon[b] + (polygon[a] - polygon[b]) * (beyond_b / (beyond_b - beyond_a)));
    if (beyond_a <= 0) scratch.push_back(polygon[a]);
  }
  polygon.swap(scratch);
}

// An angular interval without neighbours, counter-clockwise from `begin` [rad].
struct Gap {
  double begin = 0, width = 0;
  double middle() const { return begin + width / 2; }
  bool contains(double angle) const {
    return std::remainder(angle - middle(), 2 * pi) * 2 < width && std::remainder(middle() - angle, 2 * pi) * 2 < width;
  }
};

// Scratch memory of one thread, reused from point to point.
struct Workspace {
  std::vector<Neighbour> found;
  std::vector<Vector2d> flat;  // neighbours in the tangent plane, nearest first
  std::vector<double> angle;
  std::vector<Gap> gaps;
  Polygon cell, scratch;
};

// Distinct positions of a cloud and the number of points at each.
struct DistinctPoints {
  std::vector<std::uint32_t> first;     // one point of the cloud for each distinct position
  std::vector<std::uint32_t> position;  // of each point of the cloud, index into `first`
  std::vector<std::uint32_t> copies;    // at each distinct position
};

DistinctPoints find_distinct(std::span<const Vector3f> points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) { return std::array{points[i].x(), points[i].y(), points[i].z()}; };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  DistinctPoints distinct;
  distinct.position.resize(points.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k == 0 || points[order[k]] != points[order[k - 1]]) {
      distinct.first.push_back(order[k]);
      distinct.copies.push_back(0);
    }
    distinct.position[order[k]] = static_cast<std::uint32_t>(distinct.first.size() - 1);
    ++distinct.copies.back();
  }
  return distinct;
}

class AreaEstimator {
 public:
  AreaEstimator(std::span<const Vector3f> points, int neighbours)
      : points_(points), index_(points), neighbours_(static_cast<std::size_t>(neighbours)) {}

  double area(std::size_t i, const Vector3f& normal, Workspace& work) const {
    // A collinear neighbourhood (one scan line of a lidar) is enlarged until it includes the adjacent lines.
    std::size_t k = neighbours_;
    find_flat_neighbours(i, normal, k, work);
    if (work.gaps.size() > 1) find_flat_neighbours(i, normal, k *= 4, work);
    if (work.flat.empty()) return 0;
    const double nearest = work.flat.front().norm();
    if (!work.gaps.empty()) {
      const double spacing_there = spacing_at_nearest(i, work);
      if (nearest > isolation * spacing_there) return spacing_there * spacing_there;
      close_gaps(nearest, work);
    }
    return clipped_area(work);
  }

 private:
  // Finds the neighbours on the same sheet of surface, in tangent-plane coordinates, and the angular gaps between them.
  void find_flat_neighbours(std::size_t i, const Vector3f& normal, std::size_t k, Workspace& work) const {
    const Vector3d n = normal.cast<double>();
    const Vector3d t1 = n.unitOrthogonal(), t2 = n.cross(t1);
    index_.find_nearest(points_[i], k + 1, work.found);
    work.flat.clear();
    for (const Neighbour& neighbour : work.found) {
      if (neighbour.index == i) continue;
      const Vector3d d = (points_[neighbour.index] - points_[i]).cast<double>();
      const Vector2d flat(t1.dot(d), t2.dot(d));
      if (std::abs(n.dot(d)) <= flat.norm()) work.flat.push_back(flat);
    }
    find_gaps(work);
  }

  static void find_gaps(Workspace& work) {
    work.gaps.clear();
    work.angle.clear();
    for (const Vector2d& f : work.flat) work.angle.push_back(std::atan2(f.y(), f.x()));
    std::sort(work.angle.begin(), work.angle.end());
    for (std::size_t a = 0; a < work.angle.size(); ++a) {
      const double next = a + 1 < work.angle.size() ? work.angle[a + 1] : work.angle[0] + 2 * pi;
      if (next - work.angle[a] > border_gap) work.gaps.push_back({work.angle[a], next - work.angle[a]});
    }
  }

  // Distance from the nearest neighbour to its own third nearest point.
  double spacing_at_nearest(std::size_t i, Workspace& work) const {
    std::uint32_t nearest = static_cast<std::uint32_t>(i);
    for (auto n = work.found.rbegin(); n != work.found.rend(); ++n)
      if (n->index != i) nearest = n->index;
    index_.find_nearest(points_[nearest], 4, work.found);
    return std::sqrt(static_cast<double>(work.found.back().squared_distance));
  }

  // Fills gaps with mirror images of the opposite neighbours, so a border cell extends as far outwards as inwards; gaps
  // that remain wider than the limit get points at the distance of the nearest neighbour.
  static void close_gaps(double nearest, Workspace& work) {
    const std::size_t real = work.flat.size();
    const std::vector<Gap> gaps = work.gaps;
    for (std::size_t j = 0; j < real; ++j) {
      const Vector2d mirrored = -work.flat[j];
      const double angle = std::atan2(mirrored.y(), mirrored.x());
      for (const Gap& gap : gaps)
        if (gap.contains(angle)) work.flat.push_back(mirrored);
    }
    find_gaps(work);
    for (const Gap& gap : work.gaps) {
      const int parts = static_cast<int>(std::ceil(gap.width / border_gap));
      for (int p = 1; p < parts; ++p) {
        const double angle = gap.begin + gap.width * p / parts;
        work.flat.emplace_back(nearest * std::cos(angle), nearest * std::sin(angle));
      }
    }
    std::sort(work.flat.begin(), work.flat.end(),
              [](const Vector2d& a, const Vector2d& b) { return a.squaredNorm() < b.squaredNorm(); });
  }

  static double clipped_area(Workspace& work) {
    double farthest = 0;
    for (const Vector2d& f : work.flat) farthest = std::max(farthest, f.norm());
    work.cell = {{-farthest, -farthest}, {farthest, -farthest}, {farthest, farthest}, {-farthest, farthest}};
    for (const Vector2d& neighbour : work.flat) clip_by_bisector(work.cell, neighbour, work.scratch);  // (E15)
    return work.cell.size() < 3 ? 0 : area_of(work.cell);
  }

  std::span<const Vector3f> points_;
  SceneIndex index_;
  std::size_t neighbours_;
};

// Limits cell areas, since the disc of an outlier would occlude a large part of the scene.
void limit_cells(std::vector<double>& areas) {
  std::vector<double> sorted = areas;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  if (*middle > 0)
    for (double& a : areas) a = std::min(a, *middle * largest_spacing * largest_spacing);
}

}  // namespace

std::vector<float> estimate_surfel_areas(std::span<const Vector3f> points, std::span<const Vector3f> normals,
                                         const AreaOptions& options) {
  if (points.size() != normals.size())
    fail(ErrorKind::argument, "estimate_surfel_areas: ", normals.size(), " normals for ", points.size(),
         " points, must be one each");
  if (options.neighbours < 6)
    fail(ErrorKind::argument, "estimate_surfel_areas: neighbours = ", options.neighbours, ", must be at least 6");
  std::vector<float> result(points.size(), 0.0f);
  if (points.size() < 4) return result;

  // Coincident points share one cell; its area is divided among them at the end.
  const DistinctPoints distinct = find_distinct(points);
  std::vector<Vector3f> position(distinct.first.size());
  for (std::size_t d = 0; d < position.size(); ++d) position[d] = points[distinct.first[d]];
  const AreaEstimator estimator(position, options.neighbours);

  std::vector<double> areas(position.size(), 0.0);
  parallel_blocks(areas.size(), 4096, options.threads, [&](std::size_t begin, std::size_t end) {
    Workspace work;
    for (std::size_t d = begin; d < end; ++d) areas[d] = estimator.area(d, normals[distinct.first[d]], work);
  });
  limit_cells(areas);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t d = distinct.position[i];
    result[i] = static_cast<float>(areas[d] / distinct.copies[d]);
  }
  return result;
}

}  // namespace insonify
