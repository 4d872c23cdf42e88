// SPDX-License-Identifier: BSD-3-Clause
#include "run_scenes/stored_levels.hpp"

#include "core/error.hpp"
#include "files/path_status.hpp"
#include "files/sha256.hpp"
#include "run_scenes/open_scene.hpp"
#include "store/scene_file.hpp"

namespace insonify {

std::string levels_path(const std::string& scene) { return scene + ".tiles"; }

StoredLevels find_levels(const SceneOptions& scene) {
  const std::string path = levels_path(scene.path);
  if (kind_of_scene(scene.path) != SceneKind::file || !is_file(scene.path) || !path_exists(path)) return {};
  if (const std::string option = loading_option(scene); !option.empty())
    return {.note = path + " is not used: it holds levels of the scene without " + option};
  StoredLevels found;
  try {
    found.tiles.emplace(path);
  } catch (const Error& error) {
    fail(error.kind(), error.what(), "; it holds the levels of ", scene.path,
         ": insonify prepare --levels --force stores them again, and without this file pings read the cloud");
  }
  if (found.tiles->info().levels_of == sha256_of_file(scene.path)) return found;
  return {.note = path + " is not used: it holds no levels of this " + scene.path +
                  ", which may have changed since; store them again by insonify prepare --levels, or remove it"};
}

}  // namespace insonify
