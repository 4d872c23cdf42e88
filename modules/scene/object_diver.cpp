// SPDX-License-Identifier: BSD-3-Clause
// The diver swims along x, prone, with the bottle on the back.
#include <algorithm>

#include <Eigen/Geometry>

#include "core/units.hpp"
#include "scene/object_shapes_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

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
