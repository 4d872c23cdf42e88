// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "sampling/mesh_pieces_internal.hpp"

namespace insonify {

using Eigen::Vector3d;

MeshPieces::MeshPieces(const SceneMesh& mesh, std::uint64_t seed)
    : mesh_(mesh), ids_(share_out_ids(mesh)), seed_(seed) {}

std::vector<MeshPieces::IdRange> MeshPieces::share_out_ids(const SceneMesh& mesh) {
  std::vector<double> area(mesh.triangle.size());
  double total = 0;
  for (std::size_t t = 0; t < area.size(); ++t) total += area[t] = area_of(corners_of(mesh, t));
  std::vector<IdRange> ranges(area.size());
  const double ids = 0x1p32 - static_cast<double>(area.size());
  std::uint64_t next = 0;
  for (std::size_t t = 0; t < area.size(); ++t) {
    const int depth = std::clamp(static_cast<int>(std::floor(std::log2(ids * area[t] / total))), 0, 31);
    ranges[t] = {static_cast<std::uint32_t>(next), depth};
    next += std::uint64_t{1} << depth;
  }
  return ranges;
}

Piece MeshPieces::root(std::size_t t) const {
  const auto random = random_uniform(seed_, RandomStage::mesh_points, {t, 0, 1});
  Piece piece;
  piece.corner = corners_of(mesh_, t);
  piece.position = uniform_weights(random[0], random[1]);
  piece.area = area_of(piece.corner);
  piece.id = ids_[t].first;
  return piece;
}

std::array<Piece, 2> MeshPieces::bisect(const Piece& whole, std::size_t t) const {
  // The edge is chosen in scene coordinates, so that the tree does not depend on the head.
  const auto edge2 = [&](int e) { return (whole.corner[(e + 2) % 3] - whole.corner[(e + 1) % 3]).squaredNorm(); };
  const int e = edge2(0) >= edge2(1) && edge2(0) >= edge2(2) ? 0 : edge2(1) >= edge2(2) ? 1 : 2;
  const int ends[] = {(e + 1) % 3, (e + 2) % 3};
  const Vector3d middle = 0.5 * (whole.corner[ends[0]] + whole.corner[ends[1]]);
  const Vector3d weights = 0.5 * (whole.weights.col(ends[0]) + whole.weights.col(ends[1]));
  const int keeper = whole.position[ends[0]] >= whole.position[ends[1]] ? 0 : 1;  // the half with the surfel
  std::array<Piece, 2> halves = {whole, whole};
  for (int h = 0; h < 2; ++h) {
    Piece& half = halves[h];
    half.corner[ends[1 - h]] = middle;
    half.weights.col(ends[1 - h]) = weights;
    half.area = 0.5 * whole.area;
    half.node = 2 * whole.node + static_cast<std::uint64_t>(h);
    ++half.depth;
    if (h == keeper) {
      half.position[ends[h]] = whole.position[ends[h]] - whole.position[ends[1 - h]];
      half.position[ends[1 - h]] = 2 * whole.position[ends[1 - h]];
    } else {
      const auto random = random_uniform(seed_, RandomStage::mesh_points, {t, whole.node, 1});
      half.position = uniform_weights(random[0], random[1]);
      half.id = ids_[t].first + static_cast<std::uint32_t>(whole.node);
    }
  }
  return halves;
}

MeshSurfel MeshPieces::surfel_of(const Piece& piece, std::size_t triangle) const {
  const Corners& c = piece.corner;
  return {point_on(mesh_, triangle, piece.weights * piece.position),
          static_cast<float>(piece.area),
          piece.id,
          {c[0].cast<float>(), c[1].cast<float>(), c[2].cast<float>()}};
}

void reserve(std::size_t surfels, SceneCloud& scene) {
  scene.point.reserve(surfels);
  scene.normal.reserve(surfels);
  scene.area.reserve(surfels);
  scene.material.reserve(surfels);
  scene.id.reserve(surfels);
  scene.facet.reserve(surfels);
}

void append(const std::vector<MeshSurfel>& surfels, SceneCloud& scene) {
  for (const MeshSurfel& s : surfels) {
    scene.point.push_back(s.position.position.cast<float>());
    scene.normal.push_back(s.position.normal.cast<float>());
    scene.area.push_back(s.area);
    scene.material.push_back(s.position.material);
    scene.id.push_back(s.id);
    scene.facet.push_back(s.facet);
  }
}

}  // namespace insonify
