// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include "run/options.hpp"
#include "scene_io/load_scene.hpp"
#include "store/scene_file.hpp"
#include "survey/scene_parts.hpp"

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

  /// Everything that the surfels of a file depend on: the members of its SceneOptions, thin, spacing, captured.
  using Settings = std::tuple<std::string, MeaningText, std::string, std::string, std::string, std::vector<double>,
                              double, double, bool>;
  PartsOptions options_;
  LoadReport& report_;
  bool random_ = false;
  std::map<Settings, SceneBody> bodies_;
};

}  // namespace insonify
