#pragma once
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "scene_io/load_scene.hpp"
#include "tool/options.hpp"
#include "tool/ping_setup.hpp"

/// What the verbs do with .tiles files: scenes on disk of which a ping reads only what its fan reaches.
namespace insonify::tool {

bool is_tiles(const std::string& path);

/// The scene of a ping: all of a cloud or mesh, or of a .tiles file what the ping can look at.
struct PingScene {
  LoadedScene loaded;
  std::vector<Eigen::Vector3d> places;  ///< of surfels, or middles of tiles, as seen from the head
  nlohmann::ordered_json json;          ///< for the manifest
};
/// Throws Error(runtime) before reading if the part of a .tiles file would not fit into memory (--memory-limit).
PingScene load_ping_scene(const CommonOptions& common, const PingOptions& options, const PingSetup& setup);

void prepare_as_tiles(const CommonOptions& common, const PrepareOptions& options);
void make_scene_as_tiles(const CommonOptions& common, const MakeSceneOptions& options);
/// What `info` says of a .tiles file.
nlohmann::ordered_json tiles_summary(const std::string& path);

}  // namespace insonify::tool
