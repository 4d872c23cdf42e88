// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "returns/label_objects.hpp"
#include "run/options.hpp"
#include "run/ping_setup.hpp"
#include "run_scenes/any_scene.hpp"
#include "scene/prepared_scene.hpp"
#include "scene_io/load_scene.hpp"
#include "tiles/tiled_scene.hpp"

namespace insonify::tool {

/// The instances of a scene's surfels, where its file is a cloud with a field `instance`: whole numbers from 1; all
/// else is no object.
SceneInstances instances_of_scene(const std::string& path);

/// The scene of a ping: a whole cloud or mesh, a scene of parts as it is at the time of the ping, or the tiles of a .tiles file within the region of the ping.
struct PingScene {
  LoadedScene loaded;                            ///< of parts in memory the report alone
  std::shared_ptr<const PreparedScene> posed{};  ///< these parts; else absent
  std::vector<Eigen::Vector3d> places;           ///< of some surfels, or centres of tiles, in head axes [m]
  nlohmann::ordered_json json;                   ///< for the manifest

  /// Returns what is pinged.
  const SceneCloud& cloud() const { return posed ? posed->scene() : loaded.scene; }
  /// Returns the same, prepared; what is loaded must outlive it.
  std::shared_ptr<const PreparedScene> prepared(int threads) const {
    return posed ? posed : std::make_shared<const PreparedScene>(loaded.scene, threads);
  }
};
/// Ends a range that is the sonar's own where the scene ends, and adds to the notes of the head what fits the scene
/// badly. Throws Error(runtime) before reading if the part of a .tiles file would not fit into memory (--memory-limit).
PingScene load_ping_scene(const PingOptions& options, PingSetup& setup);
/// Loads from tiles that are open already, within the range as it is.
PingScene load_ping_scene(const PingOptions& options, const PingSimulator& simulator, const PingEvent& event,
                          const TiledScene& tiles);

}  // namespace insonify::tool
