// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "scene/detail_levels.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Merges surfels and nodes that lie in one cell into nodes (DetailLevels).
class MergedPieces {
 public:
  /// Largest number of surfels and nodes of one cell that are considered.
  static constexpr std::size_t most = 64;

  /// Keeps references to both arguments.
  MergedPieces(const SceneCloud& scene, std::span<const DetailNode> nodes) : scene_(scene), nodes_(nodes) {}

  /// A group of a cell's members, by their index in the cell.
  struct Group {
    std::array<std::uint8_t, most> member;
    std::uint8_t members = 0;
    std::uint16_t material = 0;
    double area = 0;
    Eigen::Vector3d normals = Eigen::Vector3d::Zero();  ///< sum of area times normal
    std::span<const std::uint8_t> all() const { return {member.data(), members}; }
  };
  static constexpr std::size_t most_groups = 8;
  struct Groups {
    std::array<Group, most_groups> group;
    std::size_t count = 0;
  };

  /// Returns the members of a cell [numbered as in DetailLevels::child], grouped by material and direction of the
  /// normal; no groups if there would be more than most_groups.
  Groups grouped(std::span<const std::uint32_t> cell) const;

  /// Returns the node for a group, without its children; nothing if the group is not a compact, flat piece.
  std::optional<DetailNode> merged(const Group& group, std::span<const std::uint32_t> cell, float edge) const;

 private:
  struct Piece {
    Eigen::Vector3f point, normal;
    float area, noise, extent, moment, thickness, resultant;
    SymmetricMatrix normals;
    std::uint32_t nearest;
    Eigen::Vector3f position;
    float own_area;
    std::uint16_t material;
  };
  Piece piece(std::uint32_t index) const;

  const SceneCloud& scene_;
  std::span<const DetailNode> nodes_;
};

}  // namespace insonify
