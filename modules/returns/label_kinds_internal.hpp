// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include "returns/pixel_labels.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Number of the label of each surfel: the label of its part, or its material if the part has no label.
struct LabelKinds {
  static constexpr std::size_t of_material = ~std::size_t{0};
  std::vector<std::size_t> of_part{};  ///< label of each part; of_material: its materials are the labels

  /// Returns the label of a surfel, index into PixelLabels::names.
  std::size_t of(const SceneCloud& scene, std::uint32_t surfel) const {
    const std::size_t kind = scene.part.empty() ? of_material : of_part[scene.part[surfel]];
    return kind == of_material ? scene.material[surfel] : kind;
  }
};

/// Lists the labels of a scene in `labels`: the materials, then the labels of parts that differ from all materials.
/// Also lists the parts.
inline LabelKinds name_kinds(const SceneCloud& scene, PixelLabels& labels) {
  LabelKinds kinds;
  std::unordered_map<std::string, std::size_t> known;  // number of each name, the first of equal ones
  for (const Material& material : scene.materials) {
    known.try_emplace(material.name, labels.names.size());
    labels.names.push_back(material.name);
  }
  for (const ScenePart& part : scene.parts) {
    if (part.label.empty()) {
      kinds.of_part.push_back(LabelKinds::of_material);
    } else {
      const auto [number, is_new] = known.try_emplace(part.label, labels.names.size());
      kinds.of_part.push_back(number->second);
      if (is_new) labels.names.push_back(part.label);
    }
    labels.part_names.push_back(part.name), labels.part_labels.push_back(part.label);
  }
  return kinds;
}

}  // namespace insonify
