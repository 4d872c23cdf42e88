// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "returns/label_objects.hpp"
#include "run/options.hpp"
#include "scene_io/load_scene.hpp"
#include "survey/parts_source.hpp"
#include "survey/scene_source.hpp"
#include "tiles/tiled_scene.hpp"

/// Scenes of all kinds, whose differences end here: clouds, meshes, rasters, tiles and scenes of parts.
namespace insonify {

class PartsOfPings;

/// The seed and rule that the draws of a scene of parts follow from.
struct RunDraws {
  std::uint64_t seed = 1;
  DrawRule rule;
};

/// How a scene is opened for pings.
struct OpenSceneOptions {
  RunDraws draws{};           ///< draws of a scene of parts; the seed is also that of samples of meshes
  int threads = 0;            ///< 0: all cores
  double memory_limit = 0;    ///< [GiB] of tiles, or of the sample of a mesh, for one ping; 0: as --memory-limit says
  bool drawn_at_will = true;  ///< moments with any draw are asked for; else only those of draws.rule
  bool keep_columns = false;  ///< LoadOptions::keep_columns
};

/// The surfels of one ping, and what a manifest says of them.
struct PingScene {
  std::shared_ptr<const PreparedScene> scene;
  LoadReport report;                       ///< what was read for the ping, with notes on it
  std::vector<Eigen::Vector3d> positions;  ///< some surfels of the whole scene, or centres of tiles, in head axes [m]
  nlohmann::ordered_json json;
};

/// A scene that is open for pings, whatever its file is. Several threads may ask at once.
class OpenScene : public SceneSource {
 public:
  /// Returns what was read, and the notes on it.
  virtual const LoadReport& report() const = 0;
  /// Returns the box of all surfels at a moment, those on disk included.
  virtual Bounds box_at(const SceneMoment& moment) const = 0;
  /// Returns the surfels of a ping.
  std::shared_ptr<const PreparedScene> scene_for(const PingSimulator& simulator, const PingEvent& event) const override;
  /// Returns the surfels of a ping with what a manifest says of them. Throws as scene_for.
  PingScene ping_scene(const PingSimulator& simulator, const PingEvent& event) const;
  /// Returns one cloud of the whole scene at a moment; of a mesh its overview.
  virtual std::shared_ptr<const SceneCloud> cloud_at(const SceneMoment& moment) const = 0;
  /// Hands over the whole scene at a moment, after which the object is empty. Throws as load_scene.
  virtual LoadedScene take_whole(const SceneMoment& moment) = 0;
  /// Returns the surfels that all pings share, prepared; null if each ping has its own.
  virtual std::shared_ptr<const PreparedScene> shared() const { return nullptr; }
  /// Returns the cloud or mesh of a file that is in memory whole; null for tiles and scenes of parts.
  virtual const LoadedScene* loaded() const { return nullptr; }
  /// Returns the scene of parts; null for another one.
  virtual const PartsOfPings* parts() const { return nullptr; }
  /// Returns the tiles on disk, also those that are the levels of a cloud; null for another scene.
  virtual const TiledScene* tiles() const { return nullptr; }
  /// Returns true for tiles, which store levels of detail.
  bool has_levels() const override { return tiles() != nullptr; }
  /// Has the points of a height field pinged, and not the surface between them; returns whether it is one.
  virtual bool leave_points() { return false; }

  /// Returns the moment of a ping with this time [s] and number.
  SceneMoment moment_of(double time, std::int64_t number) const {
    return insonify::moment_of(options_.draws.rule, time, number);
  }

 protected:
  /// Keeps how the scene is opened.
  OpenScene(SceneOptions how, const OpenSceneOptions& options) : how_(std::move(how)), options_(options) {}
  /// Returns the surfels of a ping, and adds notes on them to `report`; `json`, unless null, gets what a manifest says of
  /// them beyond scene_json. Error(runtime) before reading if tiles need more memory than the limit.
  virtual std::shared_ptr<const PreparedScene> surfels_of(const PingSimulator& simulator, const PingEvent& event,
                                                          LoadReport& report, nlohmann::ordered_json* json) const = 0;
  /// Returns PingScene::positions, of a ping that has these surfels.
  virtual std::vector<Eigen::Vector3d> positions_of(const SceneCloud& pinged, const Pose& pose) const;
  const SceneOptions how_;
  const OpenSceneOptions options_;
};

/// Opens the scene at scene.path: the one place that asks what kind of scene a path is. Pings of a cloud with levels
/// beside it (find_levels) read these. Throws as load_scene, find_levels, TiledScene and PartsOfPings; Error(argument)
/// for options of loading beside a scene of parts.
std::shared_ptr<OpenScene> open_scene(const SceneOptions& scene, const OpenSceneOptions& options = {});

/// Loads a scene of any kind whole, one of parts as it is at time 0. Throws as open_scene and take_whole.
LoadedScene load_any_scene(const SceneOptions& scene, int threads);

/// Returns the tiles of a scene that is on disk; nothing for a scene of another kind. Throws as TiledScene.
std::optional<TiledScene> find_tiles(const std::string& path);

/// Returns the box of a scene, of parts when they begin, without reading more than that needs.
Bounds box_of_scene(const std::string& path);

/// Returns the digest of a scene and of all files that it is made of; of tiles that of their checksum, which
/// covers all that they hold. Throws Error(file); for tiles as TiledScene.
std::string digest_of_scene(const std::string& path);

/// Returns the instances of a scene's surfels, where its file is a cloud with a field `instance`: whole numbers from 1;
/// all else is no object.
SceneInstances instances_of_scene(const std::string& path);

/// Returns the first option that says how a scene is read and has another value than its default; empty if none has.
std::string loading_option(const SceneOptions& options);

/// Throws Error(argument) naming the option unless all options that say how a scene is read have their defaults.
void require_no_loading_options(const SceneOptions& options, const std::string& why);

}  // namespace insonify
