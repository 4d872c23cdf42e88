// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "scene/scene_cloud.hpp"

namespace insonify {

/// Surfels and nodes that stand for the surfels of some blocks.
struct CutPiece {
  SceneCloud scene;
  std::vector<std::uint32_t> stands_for;  ///< surfel of the scene, or its id
};

/// Parts joined in the order of the scene, however its surfels are arranged in levels.
struct OrderedCut {
  SceneCloud cut;
  std::vector<std::uint32_t> order;       ///< places in the cut of the surfels of all parts
  std::vector<std::uint32_t> stands_for;  ///< surfels that those of the cut stand for

  OrderedCut(const std::vector<CutPiece>& pieces, const SceneCloud& scene, int threads);
};

/// Returns parts whose `stands_for` are ids, joined by ascending id, with all but the surfels of `like`.
SceneCloud joined_by_id(const std::vector<CutPiece>& pieces, const SceneCloud& like, bool noisy, int threads);

}  // namespace insonify
