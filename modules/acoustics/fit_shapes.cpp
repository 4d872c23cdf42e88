// SPDX-License-Identifier: BSD-3-Clause
// Shapes of smooth surfels: parts that are connected, in each of them a cylinder, a sphere or planes. Planes grow from a
// surfel's neighbourhood, again and again by least squares, as long as they find more surfels.
#include "acoustics/fit_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>

#include <Eigen/Dense>

#include "acoustics/surfel_part_internal.hpp"
#include "core/error.hpp"

namespace insonify {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr const char* fitting = "fit_shapes";
constexpr std::size_t fewest = 12;   // surfels of a plane
constexpr int most_failures = 64;    // of seeds of planes, one after the other
constexpr double along_plane = 0.9;  // cosine between its normal and those of its surfels

/// A plane by least squares: its normal on the side of those of the surfels.
struct Plane {
  Vector3d place, normal;
  double rms;
};
Plane plane_through(const SurfelPart& part) {
  const Vector3d middle = part.middle();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(
      part.moments([&](auto s) -> Vector3d { return part.point(s) - middle; }));
  Vector3d normal = axes.eigenvectors().col(0), side = Vector3d::Zero();
  for (const std::uint32_t s : part.members) side += part.scene.area[s] * part.normal(s);
  if (normal.dot(side) < 0) normal = -normal;
  return {middle, normal, std::sqrt(std::max(0.0, axes.eigenvalues()[0]))};
}

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Convex outline, counterclockwise (Andrew's monotone chain), each side moved outwards.
std::vector<Vector2d> outline_of(std::vector<Vector2d> points, double outwards) {
  std::sort(points.begin(), points.end(),
            [](auto& a, auto& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  std::vector<Vector2d> hull;
  const double flat = 0.02 * outwards * outwards;
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

/// The plane of these surfels with its edges.
Mirror mirror_of(const SurfelPart& part, const Plane& plane, const Material& material) {
  const Vector3d along = plane.normal.unitOrthogonal(), across = plane.normal.cross(along);
  std::vector<Vector2d> places;
  for (const std::uint32_t s : part.members) {
    const Vector3d p = part.point(s) - plane.place;
    places.emplace_back(along.dot(p), across.dot(p));
  }
  const std::vector<Vector2d> outline = outline_of(places, 0.5 * part.spacing());
  double area = 0;
  std::vector<Vector3d> corners;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    area += 0.5 * cross(outline[k], outline[(k + 1) % outline.size()]);
    corners.push_back(plane.place + outline[k].x() * along + outline[k].y() * across);
  }
  if (part.area() < 0.5 * area)
    fail(ErrorKind::content, fitting, ": a plane of material '", material.name, "', ", part.place(), ", fills ",
         std::round(100 * part.area() / area),
         " % of its outline, must fill half of it: give its convex parts materials of their own");
  Mirror mirror{material.name};
  mirror.reflection = material.reflection, mirror.rms_height = material.rms_height;
  mirror.thickness = std::max(part.spacing(), 3 * plane.rms);
  return with_corners(mirror, corners);
}

/// The surfels of `part` along the plane that grows from `seed`.
SurfelPart grown_from(const SurfelPart& part, std::uint32_t seed) {
  const double spacing = part.spacing(), reach = 4 * std::max(spacing, std::sqrt(double{part.scene.area[seed]}));
  SurfelPart grown = part.where([&](auto s) {
    return (part.point(s) - part.point(seed)).norm() < reach && part.normal(s).dot(part.normal(seed)) > along_plane;
  });
  for (int turn = 0; turn < 20 && grown.members.size() >= fewest; ++turn) {
    const Plane plane = plane_through(grown);
    const double near = std::max(0.5 * spacing, 3 * plane.rms);
    SurfelPart more = part.where([&](auto s) {
      return std::abs(plane.normal.dot(part.point(s) - plane.place)) < near &&
             part.normal(s).dot(plane.normal) > along_plane;
    });
    const bool settled = more.members == grown.members;
    grown.members = std::move(more.members);
    if (settled) break;
  }
  return grown;
}

std::vector<Mirror> planes_of(const SurfelPart& whole, const Material& material) {
  std::vector<Mirror> planes;
  SurfelPart rest = whole;
  for (int failures = 0; rest.members.size() >= fewest && failures < most_failures;) {
    const SurfelPart plane = grown_from(rest, rest.members[rest.members.size() / 2]);
    const bool found = plane.members.size() >= fewest;
    failures = found ? 0 : failures + 1;
    if (found) planes.push_back(mirror_of(plane, plane_through(plane), material));
    Members taken = found ? plane.members : Members{rest.members[rest.members.size() / 2]}, left;
    std::set_difference(rest.members.begin(), rest.members.end(), taken.begin(), taken.end(), std::back_inserter(left));
    rest.members = std::move(left);
  }
  return planes;
}

SmoothTarget target_of(const SurfelPart& part, const Material& material) {
  SmoothTarget target;
  target.surface.name = material.name;
  target.surface.reflection = material.reflection, target.surface.rms_height = material.rms_height;
  target.surface.thickness = part.spacing();
  target.material = part.scene.material[part.members[0]];
  return target;
}

/// Least squares of |x|^2 = 2 x . c + (r^2 - |c|^2) in the directions `across`: centre and radius of a convex round
/// surface, unless it is none.
template <int n>
std::optional<std::pair<Vector3d, double>> round_through(const SurfelPart& part,
                                                         const Eigen::Matrix<double, 3, n>& across) {
  using Row = Eigen::Matrix<double, n + 1, 1>;
  Eigen::Matrix<double, n + 1, n + 1> left = Eigen::Matrix<double, n + 1, n + 1>::Zero();
  Row right = Row::Zero();
  const Vector3d middle = part.middle();
  for (const std::uint32_t s : part.members) {
    const Eigen::Matrix<double, n, 1> x = across.transpose() * (part.point(s) - middle);
    Row row;
    row << 2 * x, 1;
    left += part.scene.area[s] * row * row.transpose();
    right += part.scene.area[s] * x.squaredNorm() * row;
  }
  const Row found = left.ldlt().solve(right);
  const Eigen::Matrix<double, n, 1> centre = found.template head<n>();
  const double radius = std::sqrt(std::max(0.0, found[n] + centre.squaredNorm()));
  double misfit = 0, outward = 0;
  for (const std::uint32_t s : part.members) {
    const Eigen::Matrix<double, n, 1> x = across.transpose() * (part.point(s) - middle) - centre;
    misfit += part.scene.area[s] * std::pow(x.norm() - radius, 2);
    outward += part.scene.area[s] * (across.transpose() * part.normal(s)).dot(x) / radius;
  }
  const bool fits = std::sqrt(misfit / part.area()) < std::min(0.02 * radius, 0.5 * part.spacing());
  if (!fits || outward < along_plane * part.area()) return std::nullopt;
  return std::pair(Vector3d(middle + across * centre), radius);
}

/// A cylinder about one of the axes of the normals' distribution, and its ends.
std::vector<SmoothTarget> cylinder_of(const SurfelPart& part, const Material& material) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(part.moments([&](auto s) { return part.normal(s); }));
  for (int k = 0; k < 3; ++k) {
    const Vector3d axis = axes.eigenvectors().col(k);
    const SurfelPart side = part.where([&](auto s) { return std::abs(part.normal(s).dot(axis)) < 0.3; });
    const auto end = [&](double sense) {
      return part.where([&](auto s) { return sense * part.normal(s).dot(axis) > along_plane; });
    };
    const SurfelPart ends[] = {end(-1), end(1)};
    if (side.members.size() < fewest || side.area() + ends[0].area() + ends[1].area() < 0.95 * part.area()) continue;
    const Vector3d along = axis.unitOrthogonal();
    const auto found = round_through<2>(side, (Eigen::Matrix<double, 3, 2>() << along, axis.cross(along)).finished());
    if (!found) continue;
    const auto [low, high] = std::minmax_element(side.members.begin(), side.members.end(), [&](auto a, auto b) {
      return axis.dot(part.point(a)) < axis.dot(part.point(b));
    });
    const double first = axis.dot(part.point(*low)), last = axis.dot(part.point(*high));
    SmoothTarget cylinder = target_of(part, material);
    cylinder.radius = found->second, cylinder.axis = axis;
    cylinder.length = last - first + side.spacing();
    cylinder.surface.place = found->first + (0.5 * (first + last) - axis.dot(found->first)) * axis;
    std::vector<SmoothTarget> all = {cylinder};
    for (const SurfelPart& plate : ends)
      if (plate.members.size() >= fewest)
        all.emplace_back(target_of(plate, material)).surface = mirror_of(plate, plane_through(plate), material);
    return all;
  }
  return {};
}

std::vector<SmoothTarget> targets_of(const SurfelPart& part, const Material& material) {
  if (part.members.size() >= fewest) {
    if (auto cylinder = cylinder_of(part, material); !cylinder.empty()) return cylinder;
    if (const auto ball = round_through<3>(part, Matrix3d::Identity())) {
      SmoothTarget sphere = target_of(part, material);
      sphere.surface.place = ball->first, sphere.radius = ball->second;
      return {sphere};
    }
  }
  std::vector<SmoothTarget> plates;
  for (const Mirror& plane : planes_of(part, material)) plates.emplace_back(target_of(part, material)).surface = plane;
  if (plates.empty())
    fail(ErrorKind::content, fitting, ": material '", material.name, "' is coherent, but its ", part.place(),
         " fit no plate, sphere or cylinder; give them another material");
  return plates;
}

}  // namespace

SmoothShapes fit_shapes(const SceneCloud& scene, const Vector3d& centre, double radius) {
  SmoothShapes shapes;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    if (!is_smooth(material)) continue;
    SurfelPart all{scene, {}};
    for (std::uint32_t s = 0; s < scene.size(); ++s)
      if (scene.material[s] == m && scene.area[s] > 0 && (all.point(s) - centre).norm() <= radius)
        all.members.push_back(s);
    if (all.members.empty()) continue;
    if (!scene.normals_oriented)
      fail(ErrorKind::content, fitting, ": material '", material.name,
           "' is smooth, but the normals of the scene have no ",
           "side; orient them by a viewpoint (prepare --viewpoint)");
    double largest = 0;
    for (const std::uint32_t s : all.members) largest = std::max(largest, double{scene.area[s]});
    for (const SurfelPart& part : connected_parts(all, 3 * std::sqrt(largest))) {
      if (material.coherent > 0)
        for (SmoothTarget& target : targets_of(part, material)) shapes.targets.push_back(std::move(target));
      if (material.mirror > 0)
        for (Mirror& plane : planes_of(part, material)) shapes.mirrors.push_back(std::move(plane));
    }
  }
  return shapes;
}

}  // namespace insonify
