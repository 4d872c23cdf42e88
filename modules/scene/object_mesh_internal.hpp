// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/pose.hpp"
#include "scene/objects.hpp"

// Private to scene: solids of triangles from which make_object puts objects together.
namespace insonify {

/// The values of an object's options.
class ObjectSizes {
 public:
  /// Throws Error(argument) as make_object does.
  ObjectSizes(const ObjectKind& kind, const ObjectSettings& settings);

  /// The value of an option, in its own unit.
  double operator()(const char* key) const;
  /// Returns the largest distance of triangles from the true surface [m].
  double tolerance() const { return 1e-3 * (*this)("tolerance_mm"); }
  /// Throws Error(argument) unless the option is below `limit`, which `what` describes.
  void require_below(const char* key, double limit, const char* what) const;

 private:
  std::size_t row_of(const char* key) const;

  const ObjectKind* kind_;
  std::vector<ObjectOption> options_;
  std::vector<double> value_;
};

/// A point of an outline that turns about an axis: along the axis and away from it [m], and its normal.
struct OutlinePoint {
  double along, radius;
  double normal_along, normal_radius;
};
/// A smooth piece of an outline. Drawn with the axis to the right and the radius upwards, it has the water on its left.
using OutlinePiece = std::vector<OutlinePoint>;

/// A straight piece of an outline.
OutlinePiece straight(double along, double radius, double to_along, double to_radius);
/// A piece of an ellipse around a centre with these half axes: the angle [rad] is 0 at the low end of `along`, pi / 2
/// at the largest radius, pi at the high end. From low angles to high ones it bounds a solid ellipse, else a hollow
/// one.
OutlinePiece elliptic(const Eigen::Vector2d& centre, const Eigen::Vector2d& half, double from, double to,
                      double tolerance);

/// The number of chords of a circle, a multiple of 4 and at least 12, that stay within `tolerance` of it [m].
int chords_of(double radius, double tolerance);

/// A point of a bar's axis, and the direction of the axis there.
struct BarPlace {
  Eigen::Vector3d at, along;
  double radius;  ///< of the round bar there [m]
};

/// Builds one mesh from solids. A solid gets the pose and the material that were set last.
class ObjectMesh {
 public:
  explicit ObjectMesh(double tolerance) : tolerance_(tolerance) {}

  double tolerance() const { return tolerance_; }
  void set_material(const char* name);
  void set_pose(const Pose& pose) { pose_ = pose; }
  /// The corners so far, in the axes of the object.
  const std::vector<Eigen::Vector3d>& corners() const { return point_; }

  /// Adds the solid of an outline that turns about the x axis. Neighbouring pieces share their ends.
  void revolve(const std::vector<OutlinePiece>& outline);
  /// An ellipsoid around the origin with these half axes.
  void add_ellipsoid(const Eigen::Vector3d& half);
  /// Adds a bar along `places`, whose bends all turn about `axis`. Its cross-section is a polygon with the perimeter of
  /// the true circle. If `closed`, the bar is a ring without ends.
  void add_bar(std::span<const BarPlace> places, const Eigen::Vector3d& axis, bool closed = false);
  /// A straight bar.
  void add_bar(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
  /// A ring of round bar around a centre; `radius` is that of the bar's axis.
  void add_ring(const Eigen::Vector3d& centre, const Eigen::Vector3d& axis, double radius, double bar_radius);
  /// The solid between two rectangles: corners 0 to 3 counter-clockwise seen from above, 4 to 7 above them.
  void add_hexahedron(const std::array<Eigen::Vector3d, 8>& corner);
  /// A box between two corners.
  void add_box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);
  /// A plate between z = 0 and `thickness`, whose convex outline in x and y is counter-clockwise.
  void add_plate(const std::vector<Eigen::Vector2d>& outline, double thickness);
  /// A flat polygon that is convex, counter-clockwise seen from outside.
  void add_polygon(std::span<const Eigen::Vector3d> corner);

  /// Turns all that is there about the origin.
  void turn(const Eigen::Matrix3d& rotation);
  /// The mesh with its lowest point at z = 0 and the origin in the centre of its box.
  SceneMesh finish() const;

 private:
  /// Throws Error(argument) if the mesh cannot take `corners` more corners.
  void require_room(std::size_t corners) const;
  std::uint32_t add_corner(const Eigen::Vector3d& point, const Eigen::Vector3d& normal);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  /// Joins rows of corners, `around` in each, the next one counter-clockwise seen along the rows.
  void join_rows(std::uint32_t first, std::size_t rows, std::size_t around, bool closed);

  double tolerance_;
  Pose pose_ = Pose::Identity();
  Eigen::Vector3d stretch_ = Eigen::Vector3d::Ones();
  std::uint16_t material_ = 0;
  std::vector<std::string> names_;
  std::vector<Eigen::Vector3d> point_, normal_;
  std::vector<std::uint16_t> corner_material_;
  std::vector<std::array<std::uint32_t, 3>> triangle_;
};

}  // namespace insonify
