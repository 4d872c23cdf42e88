// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include <Eigen/Geometry>

#include "core/units.hpp"
#include "scene/object_shapes_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using Eigen::Vector3d;

Pose axis_up() { return Pose(Eigen::AngleAxisd(-pi / 2, Vector3d::UnitY())); }

/// Lays or stands a body of revolution, as its option `upright` says.
void lay(const ObjectSizes& sizes, ObjectMesh& mesh) {
  if (sizes("upright") == 1) mesh.set_pose(axis_up());
}

/// A part of the body: an ellipsoid between two ends, with half width and half thickness, all in statures. Lengths of
/// limbs are those of Drillis and Contini (1966).
struct BodySegment {
  Vector3d from, to;
  double half_width, half_thickness;
};

const BodySegment body_segments[] = {
    {{0.185, 0, 0.01}, {0.315, 0, 0.03}, 0.047, 0.058},            // head
    {{-0.13, 0, 0}, {0.205, 0, 0.005}, 0.105, 0.066},              // torso
    {{-0.25, 0, 0}, {-0.04, 0, 0}, 0.09, 0.06},                    // hips
    {{0.16, 0.1, 0}, {0.01, 0.17, -0.05}, 0.03, 0.03},             // upper arms
    {{0.16, -0.1, 0}, {0.01, -0.17, -0.05}, 0.03, 0.03},           //
    {{0.01, 0.17, -0.05}, {0.2, 0.09, -0.12}, 0.026, 0.024},       // lower arms and hands
    {{0.01, -0.17, -0.05}, {0.2, -0.09, -0.12}, 0.026, 0.024},     //
    {{-0.19, 0.052, 0}, {-0.445, 0.078, -0.05}, 0.045, 0.047},     // thighs
    {{-0.19, -0.052, 0}, {-0.445, -0.078, 0.03}, 0.045, 0.047},    //
    {{-0.425, 0.078, -0.05}, {-0.68, 0.09, -0.025}, 0.03, 0.032},  // lower legs
    {{-0.425, -0.078, 0.03}, {-0.68, -0.09, 0.065}, 0.03, 0.032},  //
};
const BodySegment fins[] = {
    {{-0.64, 0.088, -0.022}, {-0.98, 0.105, -0.07}, 0.055, 0.007},
    {{-0.64, -0.088, 0.062}, {-0.98, -0.105, 0.115}, 0.055, 0.007},
};

void add_body_segment(ObjectMesh& mesh, const BodySegment& part, double stature) {
  const Vector3d along = (part.to - part.from).normalized(), across = Vector3d::UnitZ().cross(along).normalized();
  Pose pose = Pose::Identity();
  pose.linear() << along, across, along.cross(across);
  pose.translation() = stature * (part.from + part.to) / 2;
  mesh.set_pose(pose);
  mesh.add_ellipsoid(stature * Vector3d((part.to - part.from).norm() / 2, part.half_width, part.half_thickness));
}

}  // namespace

void build_cylinder_mine(const ObjectSizes& sizes, ObjectMesh& mesh) {
  const double radius = sizes("diameter_m") / 2, length = sizes("length_m"), nose = sizes("nose_m");
  sizes.require_below("nose_m", length, "length_m");
  mesh.set_material("steel");
  lay(sizes, mesh);
  std::vector<OutlinePiece> outline = {straight(0, 0, 0, radius), straight(0, radius, length - nose, radius)};
  if (nose > 0)
    outline.push_back(elliptic({length - nose, 0}, {nose, radius}, pi / 2, pi, mesh.tolerance() / 2));
  else
    outline.push_back(straight(length, radius, length, 0));
  mesh.revolve(outline);
}

void build_cone_mine(const ObjectSizes& sizes, ObjectMesh& mesh) {
  const double base = sizes("base_m") / 2, top = sizes("top_m") / 2, height = sizes("height_m");
  mesh.set_material("fibreglass");
  mesh.set_pose(axis_up());
  std::vector<OutlinePiece> outline = {straight(0, 0, 0, base), straight(0, base, height, top)};
  if (top > 0) outline.push_back(straight(height, top, height, 0));
  mesh.revolve(outline);
}

void build_wedge_mine(const ObjectSizes& sizes, ObjectMesh& mesh) {
  const double length = sizes("length_m"), width = sizes("width_m"), height = sizes("height_m");
  const double top_length = sizes("top_length_m"), top_width = sizes("top_width_m");
  mesh.set_material("fibreglass");
  std::array<Vector3d, 8> corner;
  for (std::size_t i = 0; i < 8; ++i) {
    const double x = i % 4 == 1 || i % 4 == 2 ? 0.5 : -0.5, y = i % 4 >= 2 ? 0.5 : -0.5;
    corner[i] = i < 4 ? Vector3d(x * length, y * width, 0) : Vector3d(x * top_length, y * top_width, height);
  }
  mesh.add_hexahedron(corner);
}

void build_sphere(const ObjectSizes& sizes, ObjectMesh& mesh) {
  mesh.set_material("steel");
  mesh.set_pose(axis_up());
  mesh.add_ellipsoid(Vector3d::Constant(sizes("diameter_m") / 2));
}

void build_drum(const ObjectSizes& sizes, ObjectMesh& mesh) {
  const double half = sizes("length_m") / 2, hoop = sizes("hoop_m"), width = sizes("hoop_width_m");
  const double body = sizes("diameter_m") / 2 - hoop, rim = sizes("rim_m"), recess = sizes("recess_m");
  sizes.require_below("hoop_m", sizes("diameter_m") / 2, "half of diameter_m");
  sizes.require_below("rim_m", body, "the radius of the drum without hoops");
  sizes.require_below("recess_m", half, "half of length_m");
  sizes.require_below("hoop_width_m", 2 * half / 3, "a third of length_m");
  mesh.set_material("steel");
  lay(sizes, mesh);
  std::vector<OutlinePiece> outline = {straight(recess - half, 0, recess - half, body - rim)};
  if (recess > 0) outline.push_back(straight(recess - half, body - rim, -half, body - rim));
  outline.push_back(straight(-half, body - rim, -half, body));
  double from = -half;
  for (const double hoop_at : {-half / 3, half / 3}) {
    outline.push_back(straight(from, body, hoop_at - width / 2, body));
    outline.push_back(elliptic({hoop_at, body}, {width / 2, hoop}, 0, pi, mesh.tolerance() / 2));
    from = hoop_at + width / 2;
  }
  outline.push_back(straight(from, body, half, body));
  outline.push_back(straight(half, body, half, body - rim));
  if (recess > 0) outline.push_back(straight(half, body - rim, half - recess, body - rim));
  outline.push_back(straight(half - recess, body - rim, half - recess, 0));
  mesh.revolve(outline);
}

void build_pipe(const ObjectSizes& sizes, ObjectMesh& mesh) {
  const double outer = sizes("diameter_m") / 2, length = sizes("length_m"), inner = outer - sizes("wall_m");
  sizes.require_below("wall_m", outer, "half of diameter_m");
  mesh.set_material("steel");
  lay(sizes, mesh);
  mesh.revolve({straight(0, outer, length, outer), straight(length, outer, length, inner),
                straight(length, inner, 0, inner), straight(0, inner, 0, outer)});
}

void build_tyre(const ObjectSizes& sizes, ObjectMesh& mesh) {
  const double outer = sizes("diameter_m") / 2, rim = sizes("rim_m") / 2, tread = sizes("tread_m") / 2;
  const double bulge = sizes("width_m") / 2 - tread, wall = sizes("wall_m"), tolerance = mesh.tolerance() / 2;
  sizes.require_below("rim_m", 2 * outer, "diameter_m");
  sizes.require_below("tread_m", sizes("width_m"), "width_m");
  const double middle = (outer + rim) / 2, half = (outer - rim) / 2;
  sizes.require_below("wall_m", std::min(half, bulge), "half of width_m - tread_m, and of the height of its sides");
  mesh.set_material("rubber");
  if (sizes("upright") == 1)
    mesh.set_pose(Pose(Eigen::AngleAxisd(pi / 2, Vector3d::UnitZ())));  // axis across
  else
    mesh.set_pose(axis_up());
  std::vector<OutlinePiece> outline = {elliptic({-tread, middle}, {bulge, half}, -pi / 2, pi / 2, tolerance),
                                       straight(-tread, outer, tread, outer),
                                       elliptic({tread, middle}, {bulge, half}, pi / 2, 3 * pi / 2, tolerance)};
  if (tread == 0) outline.erase(outline.begin() + 1);
  if (wall == 0 && tread > 0) outline.push_back(straight(tread, rim, -tread, rim));
  if (wall > 0) {
    if (tread == 0) sizes.require_below("wall_m", 0, "what a tyre without tread has");
    const Vector2d inside(bulge - wall, half - wall);
    outline.push_back(straight(tread, rim, tread, rim + wall));
    outline.push_back(elliptic({tread, middle}, inside, 3 * pi / 2, pi / 2, tolerance));
    outline.push_back(straight(tread, outer - wall, -tread, outer - wall));
    outline.push_back(elliptic({-tread, middle}, inside, pi / 2, -pi / 2, tolerance));
    outline.push_back(straight(-tread, rim + wall, -tread, rim));
  }
  mesh.revolve(outline);
}

void build_cinder_block(const ObjectSizes& sizes, ObjectMesh& mesh) {
  const double length = sizes("length_m"), width = sizes("width_m"), height = sizes("height_m");
  const double shell = sizes("shell_m"), web = sizes("web_m");
  sizes.require_below("shell_m", width / 2, "half of width_m");
  sizes.require_below("web_m", length / 3, "a third of length_m");
  mesh.set_material("concrete");
  const double core = (length - 3 * web) / 2;
  const std::array<double, 6> x = {0, web, web + core, 2 * web + core, length - web, length};
  const std::array<double, 4> y = {0, shell, width - shell, width};
  const auto solid = [](int i, int j) { return i >= 0 && i < 5 && j >= 0 && j < 3 && !(j == 1 && (i == 1 || i == 3)); };
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 3; ++j) {
      if (!solid(i, j)) continue;
      const auto at = [&](int right, int back, double z) {
        return Vector3d(x[static_cast<std::size_t>(i + right)], y[static_cast<std::size_t>(j + back)], z);
      };
      const auto wall = [&](int from_right, int from_back, int to_right, int to_back) {
        mesh.add_polygon(std::array{at(from_right, from_back, 0), at(to_right, to_back, 0),
                                    at(to_right, to_back, height), at(from_right, from_back, height)});
      };
      mesh.add_polygon(std::array{at(0, 0, height), at(1, 0, height), at(1, 1, height), at(0, 1, height)});
      mesh.add_polygon(std::array{at(0, 1, 0), at(1, 1, 0), at(1, 0, 0), at(0, 0, 0)});
      if (!solid(i, j - 1)) wall(0, 0, 1, 0);
      if (!solid(i + 1, j)) wall(1, 0, 1, 1);
      if (!solid(i, j + 1)) wall(1, 1, 0, 1);
      if (!solid(i - 1, j)) wall(0, 1, 0, 0);
    }
}

void build_diver(const ObjectSizes& sizes, ObjectMesh& mesh) {
  const double stature = sizes("stature_m"), radius = sizes("bottle_m") / 2, length = sizes("bottle_length_m");
  mesh.set_material("wet-suit");
  for (const BodySegment& part : body_segments) add_body_segment(mesh, part, stature);
  mesh.set_material("rubber");
  for (const BodySegment& fin : fins) add_body_segment(mesh, fin, stature);
  sizes.require_below("bottle_m", length, "bottle_length_m");
  mesh.set_material("aluminium");
  const double dome = 0.5 * radius;
  mesh.set_pose(Pose(Eigen::Translation3d(0.05 * stature - length / 2, 0, 0.062 * stature + radius)));
  mesh.revolve({elliptic({dome, 0}, {dome, radius}, 0, pi / 2, mesh.tolerance() / 2),
                straight(dome, radius, length - dome, radius),
                elliptic({length - dome, 0}, {dome, radius}, pi / 2, pi, mesh.tolerance() / 2)});
}

}  // namespace insonify
