// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "scene/scene_mesh.hpp"

// Private to sampling: triangles of a mesh as binary trees of parts, halved across their longest edges, each with a
// surfel (E70). The trees are fixed to the mesh.
namespace insonify {

/// A node of the tree, with the position of its surfel.
struct Piece {
  Corners corner;
  Eigen::Matrix3d weights = Eigen::Matrix3d::Identity();  ///< columns: barycentric weights of the corners
  Eigen::Vector3d position;                               ///< place of the surfel, in weights of these corners
  double area = 0;                                        ///< [m^2]
  std::uint64_t node = 1;                                 ///< children of n are 2 n and 2 n + 1
  std::uint32_t id = 0;
  int depth = 0;
};

/// A part's surfel.
struct MeshSurfel {
  MeshPoint position;
  float area;
  std::uint32_t id;
  Facet facet;
};

/// The trees of a mesh; keeps a reference to it.
class MeshPieces {
 public:
  MeshPieces(const SceneMesh& mesh, std::uint64_t seed);

  const SceneMesh& mesh() const { return mesh_; }
  Piece root(std::size_t triangle) const;
  /// Returns the halves of a part; one half keeps place and id.
  std::array<Piece, 2> bisect(const Piece& whole, std::size_t triangle) const;
  /// Returns true if there are ids for the halves.
  bool may_bisect(const Piece& piece, std::size_t triangle) const { return piece.depth < ids_[triangle].depth; }
  MeshSurfel surfel_of(const Piece& piece, std::size_t triangle) const;

 private:
  /// Share of a triangle in the 2^32 ids.
  struct IdRange {
    std::uint32_t first = 0;
    int depth = 0;  ///< 2^depth ids
  };
  static std::vector<IdRange> share_out_ids(const SceneMesh& mesh);

  const SceneMesh& mesh_;
  std::vector<IdRange> ids_;
  std::uint64_t seed_;
};

/// Reserves memory for this number of surfels with facets.
void reserve(std::size_t surfels, SceneCloud& scene);
/// Appends surfels to a scene, with their parts as facets.
void append(const std::vector<MeshSurfel>& surfels, SceneCloud& scene);

}  // namespace insonify
