// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "scene/placed_part.hpp"
#include "scene/scene_cloud.hpp"

// Private to scene: how parts become one cloud.
namespace insonify {

using PartList = std::vector<const PlacedPart*>;

/// Returns the parts in their order. Throws Error(argument) for invalid parts.
PartList list_of(std::span<const PlacedPart> parts, const char* who);
/// Returns the parts, sorted by name. Throws Error(argument) for invalid parts.
PartList by_name(std::span<const PlacedPart> parts, const char* who);
/// Throws Error(argument) for two parts of one name, and for too many parts.
void require_distinct(const std::vector<ScenePart>& parts, const char* who);

/// Returns the index of a material in the table. A new material is appended. Throws Error(argument) if it is full.
std::uint16_t material_index(const Material& material, std::vector<Material>& table, const char* who);

/// Returns the origin of the scene: that of the first captured part, otherwise a point near the first part.
Eigen::Vector3d origin_of(const PartList& parts);
/// Returns the pose that maps the cloud's coordinates to the scene's, each relative to its origin.
Eigen::Isometry3d scene_from_cloud(const SceneCloud& scene, const PlacedPart& placed);
/// Returns what a scene lists of a part.
ScenePart scene_part(const PlacedPart& placed);
/// Returns the number of surfels of a part, 0 if it is absent.
std::size_t count_of(const PlacedPart& placed);

/// Reserves memory for `more` surfels; a scene that grows several times is copied seldom.
void reserve_surfels(std::size_t more, SceneCloud& scene);
/// Appends a part with its surfels. It takes the entry of its name among the first `numbered` parts of the scene, else
/// a new one. Returns the number of the part.
std::uint16_t append_part(const PlacedPart& placed, std::size_t numbered, SceneCloud& scene, const char* who);
/// Gives surfels of a part, from `first` on, the positions of its pose.
void place_surfels(const PlacedPart& placed, std::size_t first, SceneCloud& scene);

/// Returns the cloud of a list of parts, sorted by name. The table of materials begins with `materials`, the list of
/// parts with `numbered`, in this order, of which those that are not in `list` are absent.
SceneCloud merge_list(const PartList& list, std::span<const Material> materials, std::span<const PlacedPart> numbered,
                      const char* who);

}  // namespace insonify
