// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "run/options.hpp"
#include "scene_io/load_scene.hpp"
#include "simulate/ping_simulator.hpp"
#include "store/scene_file.hpp"
#include "survey/scene_parts.hpp"
#include "tiles/tiled_scene.hpp"

namespace insonify {

/// How a scene of parts is loaded.
struct PartsOptions {
  std::uint64_t seed = 1;   ///< seed of draws, and of samples of meshes
  int threads = 0;          ///< 0: all cores
  bool drawn_anew = false;  ///< scatters are drawn for every ping, not once
};

/// Returns the settings for reading the file of a part.
SceneOptions scene_options_of(const PartFile& file);

/// The world of a scene of parts has the system of its captured files: sets that of `all` to the one that the file
/// `path` states, unless empty. Throws Error(content) if another file is in another system.
void take_system_of(const std::string& path, const std::string& system, FileMeaning& all);

/// Returns what was loaded as a body without a name, as scenes of parts take it from a file; `file` says spacing,
/// thinning and material. If not `captured`, the body has axes of its own, and surfel i has the id i.
SceneBody body_of_loaded(LoadedScene loaded, const PartFile& file, bool captured, const PartsOptions& options = {});

/// The surfels of the files that a scene of parts names. A file is read once for all parts that name it with the same
/// settings, and their bodies share the surfels.
class PartFiles {
 public:
  /// Adds what is read of each file, and the notes on it, to `report`, which must outlive this object.
  PartFiles(const PartsOptions& options, LoadReport& report) : options_(options), report_(report) {}

  /// Returns the surfels of a file as a body without a name. If not `captured`, the body has axes of its own, and
  /// surfel i has the id i. Throws as load_scene and PartsScene.
  const SceneBody& body_of(const PartFile& file, bool captured);
  /// Returns whether the surfels of a scene of parts that was read follow from the seed.
  bool is_random() const { return random_; }

 private:
  SceneBody read(const PartFile& file, bool captured);

  /// Everything that the surfels of a file depend on: path, meaning as text, the other members of its SceneOptions,
  /// thin, spacing, captured.
  using Settings = std::tuple<std::string, std::string, std::string, std::string, std::string, std::vector<double>,
                              double, double, bool>;
  PartsOptions options_;
  LoadReport& report_;
  bool random_ = false;
  std::map<Settings, SceneBody> bodies_;
};

/// A scene of parts with all its files. Captured .tiles stay on disk: of them the ground beneath the parts is read,
/// then what each ping reaches.
class PartsScene {
 public:
  /// Throws Error(content) with scene file and line for whatever its files or places lack.
  explicit PartsScene(const std::string& path, const PartsOptions& options = {});
  PartsScene(const PartsScene&) = delete;
  PartsScene& operator=(const PartsScene&) = delete;

  /// Returns the scene as its file describes it.
  const SceneFile& file() const { return file_; }
  /// Returns the parts with their surfels, but for tiles.
  const std::shared_ptr<const SceneParts>& parts() const { return parts_; }
  /// Returns what was read of all files, and the notes on each.
  const LoadReport& report() const { return report_; }
  /// Returns whether surfels or places follow from the seed: of meshes, and of bodies that are drawn.
  bool is_random() const { return random_; }
  /// Returns whether a captured part is on disk, so that each ping has a scene of its own.
  bool has_tiles() const { return !tiles_.empty(); }

  /// Returns all parts at `time` [s], tiles without surfels.
  std::vector<PlacedPart> placed_at(double time, std::uint64_t draw = 0) const;
  /// Returns the parts that rest, whatever the time, with all surfels of tiles. Throws as TiledScene::load.
  std::vector<PlacedPart> resting_with_tiles() const;
  /// Returns the box of all parts at `time`, that of whole tiles included.
  Bounds box_at(double time, std::uint64_t draw = 0) const;
  /// Returns one cloud of all parts at `time`, with all tiles. Throws as TiledScene::load.
  LoadedScene whole_at(double time, std::uint64_t draw = 0) const;
  /// Returns one cloud of all parts for one ping, with the part of tiles that it reaches. `memory` [bytes]: limit for
  /// tiles. Throws Error(runtime) before reading if they need more.
  LoadedScene scene_of(const PingSimulator& simulator, const PingEvent& event, std::uint64_t draw, double memory) const;
  /// Returns a list of the parts at `time`: name, label, file, surfels, pose, scale,
  /// size, how they move.
  nlohmann::ordered_json parts_json(double time, std::uint64_t draw = 0) const;

 private:
  std::vector<PlacedPart> resting() const;
  std::vector<PlacedPart> others_at(double time, std::uint64_t draw) const;
  SceneBody load_body(const PartFile& file, const std::string& name, bool captured, PartFiles& files);
  SceneBody read_ground(const PartFile& file, const std::string& name);

  SceneFile file_;
  PartsOptions options_;
  LoadReport report_;
  bool random_ = false;
  std::map<std::string, TiledScene> tiles_;  ///< tiles of captured parts, by name
  std::map<std::string, std::string>
      file_of_;  ///< path of the file by the name of a part, or of a body that is scattered
  std::shared_ptr<const SceneParts> parts_;
};

}  // namespace insonify
