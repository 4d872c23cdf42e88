// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "scene/scene_cloud.hpp"

namespace insonify {

/// A surface of triangles. A ping samples surfels from it as finely as it needs them (mesh_surfels). World frame;
/// coordinates in single precision relative to `origin`.
struct SceneMesh {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();    ///< [m]; world position = origin + point
  std::vector<Eigen::Vector3f> point;                  ///< corners [m], relative to origin
  std::vector<Eigen::Vector3f> normal;                 ///< normals of corners, of any length; empty: those of the faces
  std::vector<std::uint16_t> material;                 ///< materials of the corners, index into `materials`
  std::vector<std::array<std::uint32_t, 3>> triangle;  ///< corners, counter-clockwise seen from outside; none is flat
  std::vector<Material> materials = {Material{}};
  bool normals_oriented = true;  ///< false: the winding has no meaning and both sides reflect
  WholeScene whole{};            ///< SceneCloud::part_of of every sample of the mesh
};

/// Throws Error unless triangles have corners that exist, corners are finite and have materials that exist, no triangle
/// is flat, and there are no normals or one per corner. `who` names the caller in the message.
void require_valid(const SceneMesh& mesh, const char* who);

/// Corners of a triangle, relative to the origin of its mesh [m].
using Corners = std::array<Eigen::Vector3d, 3>;
/// Returns the corners of a triangle of the mesh, by its number.
Corners corners_of(const SceneMesh& mesh, std::size_t triangle);

/// Returns the area of a triangle [m^2]; 0 if a corner is not finite, or the triangle is thinner than 1e-6 of its
/// length.
double area_of(const Corners& corners);

/// A point on a mesh.
struct MeshPoint {
  Eigen::Vector3d position;  ///< [m], relative to the origin of the mesh
  Eigen::Vector3d normal;    ///< unit vector
  std::uint16_t material;    ///< material of the nearest corner
  std::uint32_t corner;      ///< index of the nearest corner
};

/// Returns the point with these barycentric weights in a triangle. If the normals of all three corners are on one side
/// of the face, they are interpolated. Otherwise the normal is that of the face, on the side of the sum of the corner
/// normals.
MeshPoint point_on(const SceneMesh& mesh, std::size_t triangle, const Eigen::Vector3d& weights);

/// Returns barycentric weights that are uniform over the triangle if `along` and `across` are uniform in [0, 1).
Eigen::Vector3d uniform_weights(double along, double across);

}  // namespace insonify
