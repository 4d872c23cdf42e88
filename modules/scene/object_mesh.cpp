// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "core/units.hpp"
#include "scene/object_mesh_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr std::size_t most_corners = 3'000'000;

/// Returns cosine and sine of `i / n` of a turn, equal to the bit for opposite quadrants.
Vector2d on_circle(int i, int n) {
  const int quadrant = 4 * (i % n) / n, rest = 4 * (i % n) - quadrant * n;
  const double angle = 2 * pi * rest / (4.0 * n);
  const double c = std::cos(angle), s = std::sin(angle);
  return quadrant == 0   ? Vector2d(c, s)
         : quadrant == 1 ? Vector2d(-s, c)
         : quadrant == 2 ? Vector2d(-c, -s)
                         : Vector2d(s, -c);
}

/// A polygon with the perimeter of a circle of radius 1.
struct BarSection {
  int sides;
  double corner;  ///< circumradius
};

BarSection section_of(double radius, double tolerance) {
  constexpr int least = 6, most = 360;
  for (int sides = least;; ++sides) {
    const double corner = pi / (sides * std::sin(pi / sides));
    const double off = radius * std::max(corner - 1, 1 - corner * std::cos(pi / sides));
    if (off <= tolerance || sides == most) return {sides, corner};
  }
}

}  // namespace

void ObjectMesh::set_material(const char* name) {
  const auto found = std::find(names_.begin(), names_.end(), name);
  material_ = static_cast<std::uint16_t>(found - names_.begin());
  if (found == names_.end()) names_.emplace_back(name);
}

std::uint32_t ObjectMesh::add_corner(const Vector3d& point, const Vector3d& normal) {
  point_.push_back(pose_ * point.cwiseProduct(stretch_));
  normal_.push_back(pose_.linear() * normal.cwiseQuotient(stretch_).normalized());
  corner_material_.push_back(material_);
  return static_cast<std::uint32_t>(point_.size() - 1);
}

void ObjectMesh::require_room(std::size_t corners) const {
  if (point_.size() + corners > most_corners)
    fail(ErrorKind::argument, "make_object: more than ", most_corners,
         " corners are needed; give a larger tolerance_mm, or fewer bars and wires");
}

void ObjectMesh::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (point_[a] == point_[b] || point_[b] == point_[c] || point_[c] == point_[a]) return;
  triangle_.push_back({a, b, c});
}

void ObjectMesh::join_rows(std::uint32_t first, std::size_t rows, std::size_t around, bool closed) {
  const auto at = [&](std::size_t row, std::size_t i) {
    return first + static_cast<std::uint32_t>(row % rows * around + i % around);
  };
  for (std::size_t row = 0; row + (closed ? 0 : 1) < rows; ++row)
    for (std::size_t i = 0; i < around; ++i) {
      add_triangle(at(row, i), at(row, i + 1), at(row + 1, i + 1));
      add_triangle(at(row, i), at(row + 1, i + 1), at(row + 1, i));
    }
}

void ObjectMesh::revolve(const std::vector<OutlinePiece>& outline) {
  double widest = 0;
  std::size_t rows = 0;
  bool curved = false;
  for (const OutlinePiece& piece : outline) {
    for (const OutlinePoint& p : piece) widest = std::max(widest, p.radius);
    rows += piece.size();
    curved = curved || piece.size() > 2;
  }
  const int around = chords_of(widest, curved ? tolerance_ / 2 : tolerance_);
  require_room(rows * static_cast<std::size_t>(around));
  const OutlinePoint* before = nullptr;
  for (const OutlinePiece& piece : outline) {
    const auto first = static_cast<std::uint32_t>(point_.size());
    for (const OutlinePoint& p : piece) {
      // Make ends that meet equal to the bit, so that triangles share their edges.
      constexpr double close = 1e-9;
      const bool meets = before && &p == &piece.front() && std::abs(p.along - before->along) < close &&
                         std::abs(p.radius - before->radius) < close;
      const OutlinePoint& position = meets ? *before : p;
      for (int i = 0; i < around; ++i) {
        const Vector2d way = on_circle(i, around);
        add_corner({position.along, position.radius * way.x(), position.radius * way.y()},
                   {p.normal_along, p.normal_radius * way.x(), p.normal_radius * way.y()});
      }
    }
    before = &piece.back();
    join_rows(first, piece.size(), static_cast<std::size_t>(around), false);
  }
}

void ObjectMesh::add_ellipsoid(const Vector3d& half) {
  const double largest = half.maxCoeff(), tolerance = tolerance_;
  tolerance_ /= largest;
  stretch_ = half;
  revolve({elliptic({0, 0}, {1, 1}, 0, pi, tolerance_ / 2)});
  stretch_ = Vector3d::Ones();
  tolerance_ = tolerance;
}

void ObjectMesh::add_bar(std::span<const BarPoint> positions, const Vector3d& axis, bool closed) {
  double thickest = 0;
  for (const BarPoint& position : positions) thickest = std::max(thickest, position.radius);
  const auto [sides, corner] = section_of(thickest, tolerance_ / 2);
  require_room((positions.size() + 2) * static_cast<std::size_t>(sides));
  const auto first = static_cast<std::uint32_t>(point_.size());
  std::vector<std::vector<Vector3d>> end(2);
  for (const BarPoint& position : positions) {
    const Vector3d along = position.along.normalized(), side = axis.normalized(), across = side.cross(along);
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * pi * i / sides;
      const Vector3d out = std::cos(angle) * across + std::sin(angle) * side;
      add_corner(position.at + corner * position.radius * out, out);
      if (&position == &positions.front()) end[0].insert(end[0].begin(), position.at + corner * position.radius * out);
      if (&position == &positions.back()) end[1].push_back(position.at + corner * position.radius * out);
    }
  }
  join_rows(first, positions.size(), static_cast<std::size_t>(sides), closed);
  if (closed) return;
  for (const std::vector<Vector3d>& polygon : end) add_polygon(polygon);
}

void ObjectMesh::add_bar(const Vector3d& from, const Vector3d& to, double radius) {
  const Vector3d along = to - from;
  const std::array<BarPoint, 2> positions = {BarPoint{from, along, radius}, BarPoint{to, along, radius}};
  add_bar(positions, along.unitOrthogonal());
}

void ObjectMesh::add_ring(const Vector3d& centre, const Vector3d& axis, double radius, double bar_radius) {
  const Vector3d x = axis.unitOrthogonal(), y = axis.normalized().cross(x);
  const int around = chords_of(radius + bar_radius, tolerance_ / 2);
  std::vector<BarPoint> positions;
  for (int i = 0; i < around; ++i) {
    const Vector2d way = on_circle(i, around);
    positions.push_back({centre + radius * (way.x() * x + way.y() * y), way.x() * y - way.y() * x, bar_radius});
  }
  add_bar(positions, axis, true);
}

void ObjectMesh::add_polygon(std::span<const Vector3d> corner) {
  Vector3d normal = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < corner.size(); ++i)
    normal += (corner[i] - corner[0]).cross(corner[i + 1] - corner[0]);
  const auto first = static_cast<std::uint32_t>(point_.size());
  for (const Vector3d& position : corner) add_corner(position, normal.normalized());
  for (std::uint32_t i = 1; i + 1 < corner.size(); ++i) add_triangle(first, first + i, first + i + 1);
}

void ObjectMesh::add_hexahedron(const std::array<Vector3d, 8>& c) {
  for (const std::array<std::size_t, 4>& side :
       {std::array<std::size_t, 4>{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}})
    add_polygon(std::array{c[side[0]], c[side[1]], c[side[2]], c[side[3]]});
}

void ObjectMesh::add_box(const Vector3d& low, const Vector3d& high) {
  std::array<Vector3d, 8> corner;
  for (std::size_t i = 0; i < 8; ++i) {
    const bool right = i % 4 == 1 || i % 4 == 2, back = i % 4 >= 2;
    corner[i] = {right ? high.x() : low.x(), back ? high.y() : low.y(), i >= 4 ? high.z() : low.z()};
  }
  add_hexahedron(corner);
}

void ObjectMesh::add_plate(const std::vector<Vector2d>& outline, double thickness) {
  std::vector<Vector3d> top, bottom;
  for (const Vector2d& p : outline) {
    top.emplace_back(p.x(), p.y(), thickness);
    bottom.insert(bottom.begin(), {p.x(), p.y(), 0});
  }
  add_polygon(top);
  add_polygon(bottom);
  for (std::size_t i = 0; i < top.size(); ++i) {
    const Vector3d &a = top[i], &b = top[(i + 1) % top.size()], down(0, 0, -thickness);
    add_polygon(std::array<Vector3d, 4>{a + down, b + down, b, a});
  }
}

void ObjectMesh::turn(const Eigen::Matrix3d& rotation) {
  for (Vector3d& p : point_) p = rotation * p;
  for (Vector3d& n : normal_) n = rotation * n;
}

SceneMesh ObjectMesh::finish() const {
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : point_) box.extend(p);
  const Vector3d origin(box.center().x(), box.center().y(), box.min().z());
  SceneMesh mesh;
  for (const Vector3d& p : point_) mesh.point.push_back((p - origin).cast<float>());
  for (const Vector3d& n : normal_) mesh.normal.push_back(n.cast<float>());
  mesh.material = corner_material_;
  mesh.triangle = triangle_;
  mesh.materials.clear();
  for (const std::string& name : names_) mesh.materials.push_back({.name = name});
  return mesh;
}

}  // namespace insonify
