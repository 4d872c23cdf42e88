// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "scene/placed_part.hpp"
#include "scene/prepared_scene.hpp"

namespace insonify {

/// Returns one cloud of all parts, in the order of their names: the order in which they are given does not count.
/// Materials that are alike in all numbers and label are one. Surfels hide as discs. Throws Error(argument) for an
/// invalid part, two parts of one name, more than 65 000 parts, and materials that do not fit into the table.
SceneCloud merge_parts(std::span<const PlacedPart> parts);

/// A scene of which some parts are placed anew for every ping: what rests is prepared once, and a part that moves costs
/// the time of its own surfels. Not for several threads at once.
class PosedScene {
 public:
  /// The parts that rest, and the materials that the others may have. Throws as merge_parts.
  explicit PosedScene(std::span<const PlacedPart> resting, std::vector<Material> others_materials = {},
                      int threads = 0);
  ~PosedScene();
  PosedScene(PosedScene&&) noexcept;
  PosedScene& operator=(PosedScene&&) noexcept;

  /// Places the other parts in place of those before, and returns the scene, which stays as it is until the next call.
  /// Throws as merge_parts.
  std::shared_ptr<const PreparedScene> pose(std::span<const PlacedPart> others);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insonify
