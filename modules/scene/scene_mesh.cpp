// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_mesh.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/error.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

Vector3d cross_of(const Corners& c) { return (c[1] - c[0]).cross(c[2] - c[0]); }

Vector3d normal_at(const SceneMesh& mesh, std::size_t triangle, const Vector3d& weights, const Vector3d& face) {
  if (mesh.normal.empty()) return face;
  Vector3d blended = Vector3d::Zero();
  double least = 1, most = -1;
  for (int corner = 0; corner < 3; ++corner) {
    const Vector3d n = mesh.normal[mesh.triangle[triangle][corner]].cast<double>();
    const double length = n.norm();
    if (!(length > 1e-12) || !std::isfinite(length)) return face;
    blended += weights[corner] * n / length;
    least = std::min(least, n.dot(face) / length);
    most = std::max(most, n.dot(face) / length);
  }
  if (least * most > 0) return blended.normalized();
  return blended.dot(face) < 0 ? Vector3d(-face) : face;
}

}  // namespace

void require_valid(const SceneMesh& mesh, const char* who) {
  const std::size_t corners = mesh.point.size();
  const auto require_length = [&](std::size_t length, const char* name) {
    if (length != corners)
      fail(ErrorKind::argument, who, ": mesh.", name, " has ", length, " entries, must have one per point (", corners,
           ")");
  };
  require_length(mesh.material.size(), "material");
  if (!mesh.normal.empty()) require_length(mesh.normal.size(), "normal");
  if (!mesh.origin.allFinite()) fail(ErrorKind::content, who, ": mesh.origin must be finite");
  for (const Material& material : mesh.materials) require_valid(material, who, ErrorKind::content);
  for (std::size_t i = 0; i < corners; ++i)
    if (mesh.material[i] >= mesh.materials.size())
      fail(ErrorKind::content, who, ": mesh.material[", i, "] = ", mesh.material[i],
           ", must be below the number of materials, ", mesh.materials.size());
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
    for (const std::uint32_t corner : mesh.triangle[t])
      if (corner >= corners)
        fail(ErrorKind::content, who, ": mesh.triangle[", t, "] has corner ", corner,
             ", must be below the number of points, ", corners);
    if (!(area_of(corners_of(mesh, t)) > 0))
      fail(ErrorKind::content, who, ": mesh.triangle[", t, "] is flat or not finite; leave such triangles out");
  }
}

Corners corners_of(const SceneMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangle[triangle];
  return {mesh.point[a].cast<double>(), mesh.point[b].cast<double>(), mesh.point[c].cast<double>()};
}

double area_of(const Corners& c) {
  const double twice = cross_of(c).norm();
  const double longest2 =
      std::max({(c[1] - c[0]).squaredNorm(), (c[2] - c[1]).squaredNorm(), (c[0] - c[2]).squaredNorm()});
  return twice > 1e-6 * longest2 && std::isfinite(twice) ? 0.5 * twice : 0;
}

MeshPoint point_on(const SceneMesh& mesh, std::size_t triangle, const Vector3d& weights) {
  const Corners corners = corners_of(mesh, triangle);
  Eigen::Index nearest = 0;
  weights.maxCoeff(&nearest);
  const std::uint32_t corner = mesh.triangle[triangle][static_cast<std::size_t>(nearest)];
  return {weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2],
          normal_at(mesh, triangle, weights, cross_of(corners).normalized()), mesh.material[corner], corner};
}

Vector3d uniform_weights(double along, double across) {
  const double height = std::sqrt(along);
  return {1 - height, height * (1 - across), height * across};
}

}  // namespace insonify
