// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>

#include "run/options.hpp"
#include "tiles/tiled_scene.hpp"

/// Levels of detail that `insonify prepare --levels` stores beside a prepared cloud: tiles of the same surfels.
namespace insonify {

/// Returns the path of the levels of a prepared cloud: its own and ".tiles".
std::string levels_path(const std::string& scene);

/// The levels of a scene, or the reason why those beside it are not used.
struct StoredLevels {
  std::optional<TiledScene> tiles{};
  std::string note{};  ///< a sentence; empty: the levels are used, or there are none
};

/// Returns the levels beside a cloud if they belong to its very bytes (SHA-256), and if the options of loading
/// have their defaults. Throws Error(file) or Error(content) with a remedy if the file of levels is unreadable or
/// damaged.
StoredLevels find_levels(const SceneOptions& scene);

}  // namespace insonify
