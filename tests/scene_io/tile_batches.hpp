// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "scene_io/prepare_tiles.hpp"
#include "tiles/tiled_scene.hpp"

namespace insonify {

/// Returns options that read even small clouds in batches.
inline PrepareTilesOptions in_batches() {
  PrepareTilesOptions options;
  options.whole_points = 0;
  return options;
}

/// Returns all surfels of a scene of tiles.
inline SceneCloud load_all(const std::string& path) {
  const TiledScene tiled(path);
  return tiled.load(tiled.select_all());
}

}  // namespace insonify
