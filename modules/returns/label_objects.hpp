// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "core/grid.hpp"
#include "returns/pixel_labels.hpp"

namespace insonify {

/// Map from the id of a surfel in the scene to its object. Surfels without an entry belong to no separate object.
using SceneInstances = std::unordered_map<std::uint32_t, std::uint32_t>;

/// Returns the numbers of the connected parts of a picture. Pixels of one key that touch at sides or corners form a
/// part. Parts are numbered from 1 in the order of their first pixels. Pixels of key 0 and parts of less than
/// `least_pixels` get 0.
Grid<std::uint32_t> connected_parts(const Grid<std::uint32_t>& key, std::size_t least_pixels);

/// Returns the keys of a picture numbered from 1 in ascending order. Key 0 and keys of less than `least_pixels` get 0.
Grid<std::uint32_t> numbered_keys(const Grid<std::uint32_t>& key, std::size_t least_pixels);

/// Returns the objects of a picture, numbered from 1. Pixels of one kind whose surfel `id` belongs to one instance form
/// an object; these come first. Then come connected parts of one kind without instances. Pixels of kind 0 and objects
/// of less than `least_pixels` get 0. Throws Error(argument) if the pictures differ in size.
Grid<std::uint32_t> number_objects(const Grid<std::uint32_t>& kind, const Grid<std::uint32_t>& id,
                                   const SceneInstances& instances, std::size_t least_pixels = 1);

/// Keys that distinguish the objects of a ping, and the instances among the keys. In a scene of parts the keys are the
/// numbers of the parts, and every part with a label is an instance. In other scenes the keys are the ids of surfels,
/// and the instances are `of_scene`.
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
