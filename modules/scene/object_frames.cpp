// SPDX-License-Identifier: BSD-3-Clause
// Objects of bars and plates.
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/units.hpp"
#include "scene/object_shapes_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

/// Adds parallel wires across a disc, along x and along y, about `spacing` apart.
void add_net(ObjectMesh& mesh, double z, double radius, double spacing, double wire) {
  const int each_side = static_cast<int>(radius / spacing);
  for (int i = -each_side; i <= each_side; ++i) {
    const double off = i * spacing, half = std::sqrt(radius * radius - off * off);
    if (half < spacing / 2) continue;
    mesh.add_bar({-half, off, z}, {half, off, z}, wire);
    mesh.add_bar({off, -half, z}, {off, half, z}, wire);
  }
}

/// Adds uprights on a circle, from z = low to high.
void add_uprights(ObjectMesh& mesh, int count, double radius, double low, double high, double bar) {
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * (i + 0.5) / count;
    const Vector3d out(radius * std::cos(angle), radius * std::sin(angle), 0);
    mesh.add_bar(out + Vector3d(0, 0, low), out + Vector3d(0, 0, high), bar);
  }
}

/// Adds the arms of an anchor with their palms: an arc in the plane y = 0 from tip to tip, its crown at the origin.
void add_arms(ObjectMesh& mesh, double span, double bar) {
  constexpr double half_angle = radians(60.0);
  const double radius = span / 2 / std::sin(half_angle);
  const int chords = std::max(
      6, static_cast<int>(std::ceil(half_angle / std::acos(1 - std::min(1.0, mesh.tolerance() / 2 / radius)))));
  std::vector<BarPoint> positions;
  for (int i = 0; i <= chords; ++i) {
    const double share = 2.0 * i / chords - 1, angle = half_angle * share;
    const double c = std::cos(angle), s = std::sin(angle);
    positions.push_back({{radius * (1 - c), 0, radius * s}, {s, 0, c}, bar * (1 - 0.6 * std::abs(share))});
  }
  mesh.add_bar(positions, Vector3d::UnitY());
  for (const double side : {-1.0, 1.0}) {
    const double angle = 0.78 * half_angle * side, c = std::cos(angle), s = std::sin(angle);
    // The palm lies along the arm, on the side of the shank.
    Pose palm = Pose::Identity();
    const Vector3d inward(c, 0, -s), to_tip = side * Vector3d(s, 0, c);
    palm.linear().col(0) = to_tip;
    palm.linear().col(1) = inward.cross(to_tip);
    palm.linear().col(2) = inward;
    palm.translation() = Vector3d(radius * (1 - c), 0, radius * s) + 0.3 * bar * inward;
    mesh.set_pose(palm);
    const double length = 0.3 * span, width = 0.26 * span;
    mesh.add_plate({{-0.5 * length, -0.32 * width},
                    {-0.1 * length, -0.5 * width},
                    {0.5 * length, 0},
                    {-0.1 * length, 0.5 * width},
                    {-0.5 * length, 0.32 * width}},
                   0.4 * bar);
  }
  mesh.set_pose(Pose::Identity());
}

}  // namespace

void build_crab_pot(const ObjectSizes& sizes, ObjectMesh& mesh) {
  const double height = sizes("height_m"), bar = sizes("bar_m") / 2, wire = sizes("wire_m") / 2;
  const double spacing = sizes("mesh_m"), ring = sizes("diameter_m") / 2 - bar;
  sizes.require_below("bar_m", std::min(height, sizes("diameter_m")) / 4, "a quarter of height_m and of diameter_m");
  const double low = bar, high = height - bar;
  mesh.set_material("steel");
  for (const double z : {low, high}) mesh.add_ring({0, 0, z}, Vector3d::UnitZ(), ring, bar);
  add_uprights(mesh, static_cast<int>(sizes("bars")), ring, low, high, bar);
  mesh.add_bar({-ring, 0, low}, {ring, 0, low}, bar);
  mesh.add_bar({0, -ring, low}, {0, ring, low}, bar);
  if (spacing == 0) return;
  sizes.require_below("wire_m", spacing / 2, "half of mesh_m");
  sizes.require_below("mesh_m", height, "height_m");
  add_net(mesh, low, ring, spacing, wire);
  add_net(mesh, high, ring, spacing, wire);
  add_uprights(mesh, std::max(3, static_cast<int>(std::lround(2 * pi * ring / spacing))), ring, low, high, wire);
  const int rings = static_cast<int>(std::lround((high - low) / spacing));
  for (int i = 1; i < rings; ++i) mesh.add_ring({0, 0, low + (high - low) * i / rings}, Vector3d::UnitZ(), ring, wire);
}

void build_anchor(const ObjectSizes& sizes, ObjectMesh& mesh) {
  const double length = sizes("length_m"), bar = sizes("bar_m") / 2, stock = sizes("stock_m");
  sizes.require_below("bar_m", std::min(length, sizes("arms_m")) / 5, "a fifth of length_m and of arms_m");
  mesh.set_material("steel");
  const std::array<BarPoint, 2> shank = {BarPoint{{0, 0, 0}, Vector3d::UnitX(), 1.1 * bar},
                                         BarPoint{{length, 0, 0}, Vector3d::UnitX(), 0.6 * bar}};
  mesh.add_bar(shank, Vector3d::UnitY());
  add_arms(mesh, sizes("arms_m"), bar);
  const double eye = 0.97 * length, thickness = 0.55 * bar;
  const std::size_t before = mesh.corners().size();
  mesh.add_bar({eye, -stock / 2, 0}, {eye, stock / 2, 0}, thickness);
  for (const double side : {-0.5, 0.5}) {
    mesh.set_pose(Pose(Eigen::Translation3d(eye, side * stock, 0)));
    mesh.add_ellipsoid(Vector3d::Constant(2.2 * thickness));
  }
  mesh.set_pose(Pose::Identity());
  // Turn the anchor until it rests on the ends of its stock and one arm.
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  for (int pass = 0; pass < 3; ++pass) {
    Vector3d rests(eye, 0, 0);
    for (std::size_t i = before; i < mesh.corners().size(); ++i)
      if (mesh.corners()[i].z() < rests.z()) rests = mesh.corners()[i];
    double steepest = -pi / 2;
    for (std::size_t i = 0; i < before; ++i) {
      const Vector3d& p = mesh.corners()[i];
      if (p.x() < rests.x() - length / 2)
        steepest = std::max(steepest, std::atan2(rests.z() - p.z(), rests.x() - p.x()));
    }
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(steepest, Vector3d::UnitY()).toRotationMatrix();
    mesh.turn(turn);
    turned = turn * turned;
  }
  // Lay the ring beside the anchor.
  double ground = 0;
  for (const Vector3d& p : mesh.corners()) ground = std::min(ground, p.z());
  Vector3d ring = turned * Vector3d(length + 1.6 * bar, 0, 0);
  ring.z() = ground + 0.4 * bar;
  mesh.add_ring(ring, Vector3d::UnitZ(), 2.2 * bar, 0.35 * bar);
}

void build_ladder(const ObjectSizes& sizes, ObjectMesh& mesh) {
  const double length = sizes("length_m"), width = sizes("width_m"), depth = sizes("rail_depth_m");
  const double rail = sizes("rail_m"), rung = sizes("rung_m") / 2, pitch = sizes("pitch_m");
  sizes.require_below("rail_m", width / 2, "half of width_m");
  sizes.require_below("rung_m", depth, "rail_depth_m");
  sizes.require_below("pitch_m", length, "length_m");
  mesh.set_material("aluminium");
  for (const double y : {0.0, width - rail}) mesh.add_box({0, y, 0}, {length, y + rail, depth});
  const int rungs = static_cast<int>(length / pitch);
  const double first = (length - (rungs - 1) * pitch) / 2;
  for (int i = 0; i < rungs; ++i)
    mesh.add_bar({first + i * pitch, rail / 2, depth / 2}, {first + i * pitch, width - rail / 2, depth / 2}, rung);
}

}  // namespace insonify
