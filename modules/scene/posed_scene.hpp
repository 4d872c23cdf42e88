// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "scene/placed_part.hpp"
#include "scene/prepared_scene.hpp"

namespace insonify {

/// Returns one cloud of all parts. The parts are sorted by name, so the order in which they are given does not matter.
/// Materials that agree in all numbers and name become one. The table of materials begins with `materials`, used or
/// not. Surfels hide as discs. Throws Error(argument) for an invalid part, two parts of one name, more than 65 000
/// parts, and materials that do not fit into the table.
SceneCloud merge_parts(std::span<const PlacedPart> parts, std::span<const Material> materials = {});

/// A scene in which some parts get a new pose for every ping. The resting parts are prepared once; a moving part costs
/// time in proportion to its own surfels. Not for use by several threads at once.
class PosedScene {
 public:
  /// Prepares the parts that rest. The table of materials begins with `materials`, used or not; if these hold all
  /// materials of all parts, the table is the same for all poses. Throws as merge_parts.
  explicit PosedScene(std::span<const PlacedPart> resting, std::span<const Material> materials = {}, int threads = 0);
  ~PosedScene();
  PosedScene(PosedScene&&) noexcept;
  PosedScene& operator=(PosedScene&&) noexcept;

  /// Returns the scene with `others` as its other parts; they replace those of the previous call. The returned scene is
  /// valid until the next call. Throws as merge_parts.
  std::shared_ptr<const PreparedScene> pose(std::span<const PlacedPart> others);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insonify
