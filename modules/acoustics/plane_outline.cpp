// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "acoustics/plane_outline_internal.hpp"
#include "core/error.hpp"
#include "scene/scene_index.hpp"

namespace insonify {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Convex outline, counterclockwise (Andrew's monotone chain); turns of less than `flat` [m^2] are no corners.
std::vector<Vector2d> convex_hull(std::vector<Vector2d> points, double flat) {
  std::sort(points.begin(), points.end(),
            [](auto& a, auto& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  std::vector<Vector2d> hull;
  for (const bool back : {false, true}) {
    const std::size_t first = hull.size();
    const auto add = [&](const Vector2d& p) {
      while (hull.size() > first + 1 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= flat)
        hull.pop_back();
      hull.push_back(p);
    };
    if (back)
      std::for_each(points.rbegin(), points.rend(), add);
    else
      std::for_each(points.begin(), points.end(), add);
    hull.pop_back();
  }
  return hull;
}

/// A convex outline whose sides are moved outwards.
std::vector<Vector2d> moved_outwards(const std::vector<Vector2d>& hull, double outwards) {
  const std::size_t n = hull.size();
  std::vector<Vector2d> moved;
  for (std::size_t k = 0; k < n; ++k) {
    const Vector2d in = (hull[k] - hull[(k + n - 1) % n]).normalized(),
                   out = (hull[(k + 1) % n] - hull[k]).normalized();
    const Vector2d normal_in(in.y(), -in.x()), normal_out(out.y(), -out.x());
    moved.push_back(hull[k] + outwards * (normal_in + normal_out) / (1 + normal_in.dot(normal_out)));
  }
  return moved;
}

double area_of(const std::vector<Vector2d>& outline) {
  double area = 0;
  for (std::size_t k = 0; k < outline.size(); ++k) area += 0.5 * cross(outline[k], outline[(k + 1) % outline.size()]);
  return area;
}

/// Mean distance to the nearest other position, times twice the root of their density: 1 at random, 2 on squares (Clark and
/// Evans 1954).
double regularity_of(const std::vector<Vector2d>& positions, double area) {
  std::vector<Eigen::Vector3f> flat;
  for (const Vector2d& position : positions) flat.emplace_back(position.x(), position.y(), 0);
  const SceneIndex index(flat);
  std::vector<Neighbour> nearest;
  double sum = 0;
  for (const Eigen::Vector3f& position : flat) {
    index.find_nearest(position, 2, nearest);
    sum += std::sqrt(static_cast<double>(nearest.back().squared_distance));
  }
  const auto count = static_cast<double>(positions.size());
  return 2 * sum / count * std::sqrt(count / area);
}

}  // namespace

double edge_beyond_centres(const std::vector<Vector2d>& positions, double area, double spacing) {
  constexpr double convex = 0.85, most_random = 1.25;
  const std::vector<Vector2d> hull = convex_hull(positions, 0.005 * spacing * spacing);
  if (hull.size() < 3 || area < convex * area_of(moved_outwards(hull, 0.5 * spacing))) return 0.5 * spacing;
  // The corners of the hull say how much of a convex surface is outside it, if places are random.
  const auto count = static_cast<double>(positions.size());
  const std::vector<Vector2d> exact = convex_hull(positions, 0);
  const auto corners = static_cast<double>(exact.size());
  if (regularity_of(positions, area) < most_random) area = area_of(exact) / (1 - corners / (count + 1));  // (E162)
  // The area of the outline grows with the distance: halve the interval that holds the one sought.
  constexpr int halvings = 40;
  double low = 0, high = spacing;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    (area_of(moved_outwards(hull, middle)) < area ? low : high) = middle;
  }
  return high;
}

Mirror mirror_of(const SurfelGroup& group, const FittedPlane& plane, const Material& material) {
  const Vector3d along = plane.normal.unitOrthogonal(), across = plane.normal.cross(along);
  std::vector<Vector2d> positions;
  double of_surfels = 0;  // as seen along the normal of the plane, from which noise turns those of surfels
  for (const std::uint32_t s : group.members) {
    const Vector3d p = group.point(s) - plane.position;
    positions.emplace_back(along.dot(p), across.dot(p));
    of_surfels += group.scene.area[s] * std::abs(group.normal(s).dot(plane.normal));
  }
  const double spacing = group.spacing();
  const std::vector<Vector2d> outline = moved_outwards(convex_hull(positions, 0.005 * spacing * spacing),
                                                       edge_beyond_centres(positions, of_surfels, spacing));
  std::vector<Vector3d> corners;
  for (const Vector2d& corner : outline) corners.push_back(plane.position + corner.x() * along + corner.y() * across);
  const double area = area_of(outline);
  if (of_surfels < 0.5 * area)
    fail(ErrorKind::content, "fit_shapes: a plane of material '", material.name, "', ", group.position_text(),
         ", fills ", std::round(100 * of_surfels / area),
         " % of its outline, must fill half of it: give its convex parts materials of their own");
  Mirror mirror{material.name};
  mirror.reflection = material.reflection, mirror.rms_height = material.rms_height;
  mirror.thickness = std::max(spacing, 3 * std::sqrt(plane.mean_square));
  return with_corners(mirror, corners);
}

}  // namespace insonify
