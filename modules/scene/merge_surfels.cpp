// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/merge_surfels_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double least_cosine_in_group = 0.866;        // between a normal and the mean of its group
constexpr double least_fill = 0.65, most_fill = 1.75;  // area over a square's of equal moment: half a square has 0.75
constexpr float of_square = 6;                         // area of a square over the mean square distance from its centre
constexpr float most_thickness = 0.1f;                 // largest thickness of a node, in extents
constexpr float uneven_noise = 1.1f;                   // largest noise of a merged surfel, in that of the node
constexpr float least_noise = 0.003f;                  // noise that makes no difference, in widths of the node
constexpr float half_diagonal = 0.70710678f;           // half the diagonal of a square, in its widths

/// Returns n n^T.
SymmetricMatrix square_of(const Vector3f& n) {
  return {n.x() * n.x(), n.x() * n.y(), n.x() * n.z(), n.y() * n.y(), n.y() * n.z(), n.z() * n.z()};
}

}  // namespace

MergedPieces::Piece MergedPieces::piece(std::uint32_t index) const {
  const std::size_t surfels = scene_.size();
  if (index >= surfels) {
    const DetailNode& n = nodes_[index - surfels];
    return {n.point,     n.normal,  n.area,    n.noise,    n.extent,   n.moment,  n.thickness,
            n.resultant, n.normals, n.nearest, n.position, n.own_area, n.material};
  }
  const float area = scene_.area[index];
  return {scene_.point[index],
          scene_.normal[index],
          area,
          scene_.noise.empty() ? 0 : scene_.noise[index],
          half_diagonal * std::sqrt(area),
          area / of_square,
          0,
          1,
          square_of(scene_.normal[index]),
          index,
          scene_.point[index],
          area,
          scene_.material[index]};
}

MergedPieces::Groups MergedPieces::grouped(std::span<const std::uint32_t> cell) const {
  Groups groups;
  for (std::size_t k = 0; k < cell.size(); ++k) {
    const Piece p = piece(cell[k]);
    const Vector3d normal = p.normal.cast<double>();
    const auto along = [&](const Group& g) {
      const double cosine = g.normals.dot(normal);
      return scene_.normals_oriented ? cosine : std::abs(cosine);
    };
    const auto joins = [&](const Group& g) {
      return g.material == p.material && along(g) >= least_cosine_in_group * g.normals.norm();
    };
    Group* const end = groups.group.data() + groups.count;
    Group* found = std::find_if(groups.group.data(), end, joins);
    if (found == end) {
      if (groups.count == most_groups) return {};
      ++groups.count;
      found->material = p.material;
    }
    const double weight = p.area * p.resultant * (found->normals.dot(normal) < 0 ? -1 : 1);
    found->member[found->members++] = static_cast<std::uint8_t>(k);
    found->normals += weight * normal;
    found->area += p.area;
  }
  return groups;
}

std::optional<DetailNode> MergedPieces::merged(const Group& group, std::span<const std::uint32_t> cell,
                                               float edge) const {
  if (group.members < 2 || !(group.area > 0) || !(group.normals.norm() > 0)) return {};
  Vector3d point = Vector3d::Zero();
  std::array<double, 6> normals{};
  double noise = 0;
  float most_noise = 0;
  for (const std::uint8_t m : group.all()) {
    const Piece p = piece(cell[m]);
    most_noise = std::max(most_noise, p.noise);
    for (std::size_t k = 0; k < normals.size(); ++k) normals[k] += p.area * p.normals[k];
    point += p.area * p.point.cast<double>();
    noise += p.area * p.noise * p.noise;
  }
  DetailNode node;
  node.point = (point / group.area).cast<float>();
  node.normal = group.normals.normalized().cast<float>();
  node.area = static_cast<float>(group.area);
  node.resultant = static_cast<float>(std::min(1.0, group.normals.norm() / group.area));
  node.noise = static_cast<float>(std::sqrt(noise / group.area));
  // A surfel of large noise hides little. A node with the smaller mean noise would hide more, so these do not merge.
  if (most_noise > uneven_noise * node.noise + least_noise * std::sqrt(node.area)) return {};
  for (std::size_t k = 0; k < normals.size(); ++k) node.normals[k] = static_cast<float>(normals[k] / group.area);
  node.material = group.material;
  node.children = group.members;
  node.cell = edge;
  double moment = 0;
  float nearest = std::numeric_limits<float>::infinity();
  for (const std::uint8_t m : group.all()) {
    const Piece p = piece(cell[m]);
    const Vector3f away = p.point - node.point;
    const float distance = away.norm();
    moment += p.area * (p.moment + away.squaredNorm());
    node.extent = std::max(node.extent, distance + p.extent);
    node.thickness = std::max(node.thickness, std::abs(away.dot(node.normal)) + p.thickness);
    if (distance < nearest)
      nearest = distance, node.nearest = p.nearest, node.position = p.position, node.own_area = p.own_area;
  }
  node.moment = static_cast<float>(moment / group.area);
  const double fill = group.area / (of_square * node.moment);
  if (fill < least_fill || fill > most_fill || node.thickness > most_thickness * node.extent) return {};
  return node;
}

}  // namespace insonify
