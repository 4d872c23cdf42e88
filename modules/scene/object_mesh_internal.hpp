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

  /// Returns the value of an option, in the option's unit.
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
/// A smooth piece of an outline. With the axis to the right and the radius upwards, water is on the left of the piece.
using OutlinePiece = std::vector<OutlinePoint>;

/// Returns a straight piece of an outline.
OutlinePiece straight(double along, double radius, double to_along, double to_radius);
/// Returns a piece of an ellipse with these half axes. The angle [rad] is 0 at the low end of `along`, pi / 2 at the
/// largest radius, pi at the high end. From low angles to high ones the ellipse is solid, otherwise hollow.
OutlinePiece elliptic(const Eigen::Vector2d& centre, const Eigen::Vector2d& half, double from, double to,
                      double tolerance);

/// Returns the number of chords, a multiple of 4 and at least 12, that stay within `tolerance` [m] of a circle.
int chords_of(double radius, double tolerance);

/// A point of a bar's axis, with the direction of the axis and the radius of the bar there.
struct BarPoint {
  Eigen::Vector3d at, along;
  double radius;  ///< radius of a round bar [m]
};

/// Builds one mesh from solids. A solid gets the pose and the material that were set last.
class ObjectMesh {
 public:
  explicit ObjectMesh(double tolerance) : tolerance_(tolerance) {}

  double tolerance() const { return tolerance_; }
  void set_material(const char* name);
  void set_pose(const Pose& pose) { pose_ = pose; }
  /// Returns the corners so far, in the axes of the object.
  const std::vector<Eigen::Vector3d>& corners() const { return point_; }

  /// Adds the solid of an outline that turns about the x axis. Neighbouring pieces share their ends.
  void revolve(const std::vector<OutlinePiece>& outline);
  /// Adds an ellipsoid around the origin with these half axes.
  void add_ellipsoid(const Eigen::Vector3d& half);
  /// Adds a bar along `positions`, whose bends all turn about `axis`. Its cross-section is a polygon with the perimeter of
  /// the true circle. If `closed`, the bar is a ring without ends.
  void add_bar(std::span<const BarPoint> positions, const Eigen::Vector3d& axis, bool closed = false);
  /// Adds a straight bar.
  void add_bar(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
  /// Adds a ring of round bar around a centre; `radius` is that of the bar's axis.
  void add_ring(const Eigen::Vector3d& centre, const Eigen::Vector3d& axis, double radius, double bar_radius);
  /// Adds the solid between two rectangles: corners 0 to 3 counter-clockwise seen from above, 4 to 7 above them.
  void add_hexahedron(const std::array<Eigen::Vector3d, 8>& corner);
  /// Adds a box between two corners.
  void add_box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);
  /// Adds a plate between z = 0 and `thickness` with a convex outline in x and y, counter-clockwise.
  void add_plate(const std::vector<Eigen::Vector2d>& outline, double thickness);
  /// Adds a flat, convex polygon, counter-clockwise seen from outside.
  void add_polygon(std::span<const Eigen::Vector3d> corner);

  /// Turns all solids so far about the origin.
  void turn(const Eigen::Matrix3d& rotation);
  /// Returns the mesh with its lowest point at z = 0 and the origin in the centre of its box.
  SceneMesh finish() const;

 private:
  /// Throws Error(argument) if the mesh cannot take `corners` more corners.
  void require_room(std::size_t corners) const;
  std::uint32_t add_corner(const Eigen::Vector3d& point, const Eigen::Vector3d& normal);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  /// Joins consecutive rows of `around` corners each, counter-clockwise seen along the rows.
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
