// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "store/mission_file.hpp"
#include "survey/scene_source.hpp"

namespace insonify {

/// Opens the scene at `path`, a cloud, mesh, raster, .tiles or scene of parts (.toml), for any pings: of a mesh or tiles
/// each ping takes what it needs, and parts stand where they are at its time. `seed`: of samples and of what is drawn;
/// `threads`: of loading, 0: all cores. Throws as load_scene and TiledScene; Error(content) with file and line for a
/// scene of parts.
std::shared_ptr<const SceneSource> scene_source_of(const std::string& path, std::uint64_t seed = 1, int threads = 0);

/// Opens the scene of a mission as its tables [survey], [scene], [ping] and [randomise] say. Throws as above, and
/// Error(content) for these tables.
std::shared_ptr<const SceneSource> scene_source_of(const MissionFile& file, int threads = 0);

/// Draws the poses of a mission that has [randomise.pose] over its scene, opened by scene_source_of(file): clear of the
/// ground, of moving parts and of the bodies of each ping's draw (E198). Another mission stays as it is. Throws
/// Error(content) naming file and ping if no place is clear; as TiledScene::load.
void draw_poses(MissionFile& file, const SceneSource& scene);

}  // namespace insonify
