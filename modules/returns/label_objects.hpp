// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/grid.hpp"
#include "returns/pixel_labels.hpp"

namespace insonify {

/// The objects of a scene, numbered once for all its pings.
struct SceneInstances {
  /// Number of the object of a surfel, by the id of the surfel in the scene. Surfels without an entry belong to no
  /// object.
  std::unordered_map<std::uint32_t, std::uint32_t> of_surfel{};
  std::map<std::uint32_t, std::uint32_t> renumbered{};  ///< given id, by the number that stands for it
  std::uint32_t most = 0;                               ///< largest number; 0: no objects

  bool operator==(const SceneInstances&) const = default;
};

/// Returns the objects of surfels, by pairs of the id of a surfel and the id given to its object. Given ids from 1 to
/// 65534 stay. 0 is no object. Larger ids get the lowest free numbers in ascending order, and are in `renumbered`.
SceneInstances number_instances(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& given);

/// Returns the numbers of the connected parts of a picture. Pixels of one key that touch at sides or corners form a
/// part. Parts are numbered from 1 in the order of their first pixels. Pixels of key 0 and parts of less than
/// `least_pixels` get 0.
Grid<std::uint32_t> connected_groups(const Grid<std::uint32_t>& key, std::size_t least_pixels);

/// Returns the objects of a picture. Pixels of any kind whose surfel `id` belongs to an instance have the number of the
/// instance. Connected parts of one kind without instances have the numbers after instances.most, in the order of their
/// first pixels. Pixels of kind 0 and objects of less than `least_pixels` get 0. Throws Error(argument) if the pictures
/// differ in size.
Grid<std::uint32_t> number_objects(const Grid<std::uint32_t>& kind, const Grid<std::uint32_t>& id,
                                   const SceneInstances& instances, std::size_t least_pixels = 1);

/// Keys that distinguish the objects of a ping, and the instances among the keys. In a scene of parts the keys are the
/// indices of the parts, every part with a label is an instance, its number is of_scene.most + its index + 1, and
/// instances.most is of_scene.most + the number of all parts; surfels of the first part that are instances of
/// `of_scene` stay these. In other scenes the keys are the ids of surfels, and the instances are `of_scene`.
struct ObjectKeys {
  Grid<std::uint32_t> id;
  SceneInstances instances;
};
/// Returns the keys of the pixels that receive at least `least_share` of their energy from one label.
ObjectKeys object_keys(const PixelLabels& labels, const SceneInstances& of_scene, double least_share);

/// Returns the objects of a ping, beams x bins (number_objects). The kinds are the materials of material_image (E125),
/// the instances those of object_keys.
Grid<std::uint32_t> instance_image(const PixelLabels& labels, const SceneInstances& instances = {},
                                   double least_share = 0.5);

}  // namespace insonify
