// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "run_scenes/open_scene.hpp"
#include "store/scene_file.hpp"
#include "survey/parts_source.hpp"

namespace insonify {

/// Returns the settings for reading the file of a part.
SceneOptions scene_options_of(const PartFile& file);

/// The world of a scene of parts has the system of its captured files: sets that of `all` to the one that the file
/// `path` states, unless empty. Throws Error(content) if another file is in another system.
void take_system_of(const std::string& path, const std::string& system, FileMeaning& all);

/// Returns what was loaded as a body without a name, as scenes of parts take it from a file; `file` says spacing,
/// thinning and material. If not `captured`, the body has axes of its own, and surfel i has the id i.
SceneBody body_of_loaded(LoadedScene loaded, const PartFile& file, bool captured, const OpenSceneOptions& options = {});

/// The surfels of the files that a scene of parts names. A file is read once for all parts that name it with the same
/// settings, and their bodies share the surfels.
class PartFiles {
 public:
  /// Adds what is read of each file, and the notes on it, to `report`; both must outlive this object.
  PartFiles(const OpenSceneOptions& options, LoadReport& report) : options_(options), report_(report) {}

  /// Returns the surfels of a file as a body without a name. If not `captured`, the body has axes of its own, and
  /// surfel i has the id i. Throws as load_scene and PartsOfPings.
  const SceneBody& body_of(const PartFile& file, bool captured);
  /// Returns whether the surfels of a scene of parts that was read follow from the seed.
  bool is_random() const { return random_; }

 private:
  SceneBody read(const PartFile& file, bool captured);

  /// Everything that the surfels of a file depend on: path, meaning as text, the other members of its SceneOptions,
  /// thin, spacing, captured.
  using Settings = std::tuple<std::string, std::string, std::string, std::string, std::string, std::vector<double>,
                              double, double, bool>;
  const OpenSceneOptions& options_;
  LoadReport& report_;
  bool random_ = false;
  std::map<Settings, SceneBody> bodies_;
};

/// Returns the bytes that tiles may take: --memory-limit [GiB], or for 0 the available memory.
double memory_for_tiles(double limit_gib);

/// A scene of parts with all its files, as each ping finds it: by its time and its draw. Captured .tiles stay on disk: of
/// them the ground beneath the parts is read, then what each ping reaches.
class PartsOfPings : public OpenScene {
 public:
  /// Throws Error(content) with scene file and line for whatever its files or places lack; Error(argument) for options of
  /// loading, which the scene's file gives.
  explicit PartsOfPings(const SceneOptions& how, const OpenSceneOptions& options = {});
  /// Prepares the first scene of pings if no part is on disk, so that its errors appear now. Throws as PosedScene.
  void prepare() const;

  /// Returns the scene as its file describes it.
  const SceneFile& file() const { return file_; }
  /// Returns the parts with their surfels, but for tiles.
  const SceneParts& scene() const { return *parts_; }
  /// Returns what was read of all files, and the notes on each.
  const LoadReport& report() const override { return report_; }
  /// Returns whether surfels or places follow from the seed: of meshes, and of bodies that are drawn.
  bool is_random() const { return random_; }
  /// Returns whether a captured part is on disk, so that each ping has a scene of its own.
  bool has_tiles() const { return !tiles_.empty(); }
  /// Returns this object.
  const PartsOfPings* parts() const override { return this; }

  /// Returns all parts at a moment, tiles without surfels. Throws as SceneParts::others_at.
  std::vector<PlacedPart> placed_at(const SceneMoment& moment) const;
  /// Returns the parts that rest, whatever the time, with all surfels of tiles. Throws as TiledScene::load.
  std::vector<PlacedPart> resting_with_tiles() const;
  /// Returns the box of all parts, that of whole tiles included.
  Bounds box_at(const SceneMoment& moment) const override;
  /// Returns one cloud of all parts, with all tiles; the object stays as it is. Throws as TiledScene::load.
  LoadedScene take_whole(const SceneMoment& moment) override;
  /// Returns a list of the parts at a moment: name, label, file, surfels, pose, scale, size, how they move.
  nlohmann::ordered_json parts_json(const SceneMoment& moment) const;

  /// Returns the parts if none moves, is drawn anew or on disk.
  std::shared_ptr<const PreparedScene> shared() const override;
  /// Returns all of the scene at a moment, with all tiles; the same object while its parts stand alike and it is in
  /// use. Throws as placed_at and TiledScene::load.
  std::shared_ptr<const PreparedScene> whole_at(const SceneMoment& moment) const;
  /// Returns the cloud of whole_at, which lives as long as the pointer.
  std::shared_ptr<const SceneCloud> cloud_at(const SceneMoment& moment) const override;

 private:
  std::shared_ptr<const PreparedScene> surfels_of(const PingSimulator& simulator, const PingEvent& event,
                                                  LoadReport& report, nlohmann::ordered_json* json) const override;
  std::vector<PlacedPart> resting() const;
  std::vector<PlacedPart> others_at(const SceneMoment& moment) const;
  SceneBody load_body(const PartFile& file, const std::string& name, bool captured, PartFiles& files);
  SceneBody read_ground(const PartFile& file, const std::string& name);
  const PartsSource& whole() const;

  SceneFile file_;
  LoadReport report_;
  bool random_ = false;
  std::map<std::string, TiledScene> tiles_;  ///< tiles of captured parts, by name
  std::map<std::string, std::string>
      file_of_;  ///< path of the file by the name of a part, or of a body that is scattered
  std::shared_ptr<const SceneParts> parts_;
  mutable std::mutex guard_;
  mutable std::optional<PartsSource> whole_;  ///< with all tiles, once it was asked for
};

}  // namespace insonify
