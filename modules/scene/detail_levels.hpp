// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "scene/scene_cloud.hpp"

namespace insonify {

/// Upper triangle of a symmetric matrix, row by row: xx, xy, xz, yy, yz, zz.
using SymmetricMatrix = std::array<float, 6>;

/// One surfel that stands for neighbouring surfels of one material on one smooth piece of surface (E137).
struct DetailNode {
  /// Area-weighted mean of the surfels' centres [m], relative to the scene's origin.
  Eigen::Vector3f point = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< area-weighted mean of their normals, a unit vector
  float area = 0;                                    ///< sum of their areas [m^2]
  float noise = 0;                                   ///< root of their area-weighted mean square [m]
  float extent = 0;                                  ///< radius about `point` of a ball that holds the surfels [m]
  float moment = 0;           ///< mean square distance of the surfels' surface from `point` [m^2]
  float thickness = 0;        ///< largest distance of a child's centre from the plane, plus its thickness [m]
  float resultant = 0;        ///< length of the area-weighted mean of the surfels' normals
  SymmetricMatrix normals{};  ///< area-weighted mean of n n^T over the surfels' normals n
  std::uint32_t nearest = 0;  ///< surfel that the child nearest to `point` stands for; the node has its id
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< centre of that surfel [m], relative to the scene's origin
  float own_area = 0;                                  ///< area of that surfel [m^2]
  std::uint32_t first_child = 0;                       ///< index into DetailLevels::child
  std::uint16_t children = 0;                          ///< number of children
  std::uint16_t material = 0;                          ///< material of all surfels below
  float cell = 0;                                      ///< edge of the cubic cell that holds the children's centres [m]
};

/// Consecutive roots of the levels, and a bounding ball of the surfels below them.
struct DetailBlock {
  Eigen::Vector3f centre;            ///< [m], relative to the scene's origin
  float radius = 0;                  ///< [m]
  float largest_area = 0;            ///< area of the largest surfel [m^2]
  std::uint32_t begin = 0, end = 0;  ///< range of DetailLevels::root
};

/// Levels of detail of a scene: a forest over its surfels. A node replaces its children where a sonar does not resolve
/// them. Cells are cubes with an edge of a power of two metres, aligned with the scene's own origin, so the nodes
/// within a cell depend only on the surfels in it.
///
/// Within a cell, children of one material whose normals lie within 30 degrees of each other are merged if together
/// they are one compact, flat piece. Such a piece is no thicker than a tenth of its extent, and neither sparse nor in
/// several sheets: its area is 0.65 to 1.75 times that of a square with the same moment. Rods, nets and rough ground
/// may fail this test in one cell and merge in a larger one; otherwise their surfels stay single (rows of single
/// surfels merge in pairs).
struct DetailLevels {
  std::size_t surfels = 0;           ///< number of surfels in the scene
  std::vector<DetailNode> node;      ///< each stands for at least two children
  std::vector<std::uint32_t> child;  ///< per node: below `surfels`, a surfel; else `surfels` + index of a node
  std::vector<std::uint32_t> root;   ///< nodes and surfels without a parent, along a Morton curve; numbered as `child`
  std::vector<DetailBlock> block;    ///< blocks of roots
};

/// Returns d^T m d: for the normals of a node, the mean square cosine of the angle between them and `d`.
inline double quadratic_form(const SymmetricMatrix& m, const Eigen::Vector3d& d) {
  return m[0] * d.x() * d.x() + m[3] * d.y() * d.y() + m[5] * d.z() * d.z() +
         2 * (m[1] * d.x() * d.y() + m[2] * d.x() * d.z() + m[4] * d.y() * d.z());
}

/// Number of doublings of the edges of cells.
inline constexpr int detail_doublings = 10;
/// Returns the edge of the smallest cells of a scene with this spacing [m].
double finest_cell(double spacing);

/// Returns the levels of a scene. The smallest cells have an edge of an eighth of `spacing` [m]; ten doublings follow.
/// With a spacing of 0 no surfels merge. Takes O(n) time and memory; the result does not depend on `threads` (0: all
/// cores). Throws Error(argument) for surfels with facets and for more than 2^30 surfels.
DetailLevels detail_levels(const SceneCloud& scene, double spacing, int threads = 0);

}  // namespace insonify
