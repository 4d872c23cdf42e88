// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "core/grid.hpp"
#include "returns/pixel_labels.hpp"

namespace insonify {

/// The object of a surfel, by its id in the scene; ids that are not in it are of no object of their own.
using SceneInstances = std::unordered_map<std::uint32_t, std::uint32_t>;

/// Numbers the parts of a picture that are of one key and connected by sides or corners, from 1 in the order of their
/// first pixels; pixels of key 0 and parts of less than `least_pixels` get 0.
Grid<std::uint32_t> connected_parts(const Grid<std::uint32_t>& key, std::size_t least_pixels);

/// Numbers the keys of a picture from 1 in their order; keys of less than `least_pixels` get 0, as does key 0.
Grid<std::uint32_t> numbered_keys(const Grid<std::uint32_t>& key, std::size_t least_pixels);

/// Numbers the objects of a picture from 1: first pixels of one kind whose surfel `id` is of one instance, then
/// connected parts of one kind without instances. Pixels of kind 0 and objects of less than `least_pixels` get 0.
/// Throws Error(argument) if the pictures differ in size.
Grid<std::uint32_t> number_objects(const Grid<std::uint32_t>& kind, const Grid<std::uint32_t>& id,
                                   const SceneInstances& instances, std::size_t least_pixels = 1);

/// What the objects of a ping differ by: the ids of surfels, or of a scene of parts the numbers of the parts; and
/// the instances among them: of parts all that have a label, else `of_scene`.
struct ObjectKeys {
  Grid<std::uint32_t> id;
  SceneInstances instances;
};
/// Returns them for the pixels that have at least this share of their energy from one label.
ObjectKeys object_keys(const PixelLabels& labels, const SceneInstances& of_scene, double least_share);

/// The objects of a ping, beams x bins, where kinds are the materials of material_image (E125), and instances those of
/// object_keys.
Grid<std::uint32_t> instance_image(const PixelLabels& labels, const SceneInstances& instances = {},
                                   double least_share = 0.5);

}  // namespace insonify
