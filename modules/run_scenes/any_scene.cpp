// SPDX-License-Identifier: BSD-3-Clause
#include "run_scenes/any_scene.hpp"

#include <filesystem>
#include <map>

#include "core/error.hpp"
#include "files/sha256.hpp"
#include "run/ping_setup.hpp"
#include "run/run_settings.hpp"
#include "run_scenes/parts_scene.hpp"
#include "store/scene_file.hpp"
#include "tiles/tiled_scene.hpp"

namespace insonify {

namespace fs = std::filesystem;

bool is_tiles(const std::string& path) { return fs::path(path).extension() == ".tiles"; }

LoadedScene load_any_scene(const CommonOptions& common, const SceneOptions& scene, double time) {
  if (!is_scene_file(scene.path)) return load_scene(scene.path, load_options(common, scene));
  require_no_loading_options(scene, "says itself how each part is read; give it there");
  return PartsScene(scene.path, {.seed = common.seed, .threads = common.threads}).whole_at(time);
}

std::string digest_of_scene(const std::string& path) {
  if (is_scene_file(path)) {
    Sha256 sha;
    std::map<std::string, std::string> digests;
    for (const std::string& file : files_of(load_scene_file(path))) {
      std::string& digest = digests[file];
      if (digest.empty()) digest = is_scene_file(file) ? sha256_of_file(file) : digest_of_scene(file);
      sha.add(fs::path(file).filename().string() + ":" + digest + "\n");
    }
    return sha.digest();
  }
  if (!is_tiles(path)) return sha256_of_file(path);
  return sha256_of(std::to_string(TiledScene(path).info().checksum));
}

void require_no_loading_options(const SceneOptions& o, const std::string& why) {
  SceneOptions given = o, none;
  none.path = o.path;
  const auto settings = scene_settings(given), defaults = scene_settings(none);
  for (std::size_t i = 0; i < settings.size(); ++i)
    if (settings_as_toml({settings[i]}) != settings_as_toml({defaults[i]}))
      fail(ErrorKind::argument, settings[i].option, ": ", o.path, " ", why);
}

}  // namespace insonify
