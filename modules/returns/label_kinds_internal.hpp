// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "returns/pixel_labels.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Number of the label of each surfel: the label of its part, or its material if the part has no label.
struct LabelKinds {
  static constexpr std::size_t of_material = ~std::size_t{0};
  std::vector<std::size_t> of_part{};  ///< of each part; of_material: its materials are the labels

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
  for (const Material& material : scene.materials) labels.names.push_back(material.name);
  for (const ScenePart& part : scene.parts) {
    const auto known = std::find(labels.names.begin(), labels.names.end(), part.label);
    const auto number = static_cast<std::size_t>(known - labels.names.begin());
    kinds.of_part.push_back(part.label.empty() ? LabelKinds::of_material : number);
    if (!part.label.empty() && known == labels.names.end()) labels.names.push_back(part.label);
    labels.part_names.push_back(part.name), labels.part_labels.push_back(part.label);
  }
  return kinds;
}

}  // namespace insonify
