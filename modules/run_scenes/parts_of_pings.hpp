// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "run_scenes/open_scene.hpp"
#include "run_scenes/parts_scene.hpp"
#include "survey/parts_source.hpp"

namespace insonify {

/// Returns the bytes that tiles may take: --memory-limit [GiB], or for 0 the available memory.
double memory_for_tiles(double limit_gib);

/// A scene of parts as each ping finds it: by its time and its draw.
class PartsOfPings : public OpenScene {
 public:
  /// Throws as PartsScene; Error(argument) for options of loading, which the scene's file gives.
  PartsOfPings(const SceneOptions& how, const OpenSceneOptions& options);

  /// Returns the parts with what was read of them.
  const PartsScene& scene() const { return scene_; }
  /// Returns what was read of all files, and the notes on each.
  const LoadReport& report() const override { return scene_.report(); }
  /// Returns the box of all parts, that of whole tiles included.
  Bounds box_at(const SceneMoment& moment) const override { return scene_.box_at(moment.time, moment.draw); }
  /// Returns one cloud of all parts, with all tiles; the object stays as it is.
  LoadedScene take_whole(const SceneMoment& moment) override { return scene_.whole_at(moment.time, moment.draw); }
  /// Returns the parts if none moves, is drawn anew or on disk.
  std::shared_ptr<const PreparedScene> shared() const override;
  /// Returns this object.
  const PartsOfPings* parts() const override { return this; }

  /// Returns what a ping needs of the scene at its moment: of tiles what it reaches. Throws as PartsScene::placed_at;
  /// Error(runtime) before reading if tiles need more memory than the limit.
  std::shared_ptr<const PreparedScene> scene_for(const PingSimulator& simulator, const PingEvent& event) const override;
  /// Returns the same with what a manifest says of it.
  PingScene ping_scene(const PingSimulator& simulator, const PingEvent& event) const override;
  /// Returns all of the scene at a moment, with all tiles; the same object while its parts stand alike and it is in
  /// use. Throws as PartsScene::placed_at and TiledScene::load.
  std::shared_ptr<const PreparedScene> whole_at(const SceneMoment& moment) const;
  /// Returns the cloud of whole_at, which lives as long as the pointer.
  std::shared_ptr<const SceneCloud> cloud_at(const SceneMoment& moment) const override;

 private:
  PartsScene scene_;
  std::optional<PartsSource> source_;  ///< without tiles
  mutable std::mutex guard_;
  mutable std::optional<PartsSource> whole_;  ///< with all tiles, if they were asked for
};

}  // namespace insonify
