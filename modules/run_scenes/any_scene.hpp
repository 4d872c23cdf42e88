// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "run/options.hpp"
#include "scene_io/load_scene.hpp"

/// What is asked of scenes of all kinds: clouds, meshes, tiles and scenes of parts.
namespace insonify {

/// Loads a scene of any kind: a cloud, a mesh, tiles, or a scene of parts as it is at `time` [s]. Throws as load_scene
/// and PartsScene; Error(argument) for options of loading beside a scene of parts.
LoadedScene load_any_scene(const CommonOptions& common, const SceneOptions& scene, double time = 0);

/// Returns the digest of a scene and of all files that it is made of; of tiles that of their checksum, which
/// covers all that they hold. Throws Error(file); for tiles as TiledScene.
std::string digest_of_scene(const std::string& path);

/// Throws Error(argument) naming the option unless all options that say how a scene is read have their defaults.
void require_no_loading_options(const SceneOptions& options, const std::string& why);

/// True for a .tiles file: a scene on disk of which a ping reads only what its fan reaches.
bool is_tiles(const std::string& path);

}  // namespace insonify
