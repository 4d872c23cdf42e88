// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "scene/meaning_override.hpp"
#include "survey/part_placement.hpp"

namespace insonify {

/// How a scene is stored: one cloud, mesh or raster; tiles on disk; or a scene file of parts.
enum class SceneKind { file, tiles, parts };

/// Returns the kind of scene that a path names, by its ending: .tiles, .toml, or another one.
SceneKind kind_of_scene(const std::string& path);

struct SceneFile;

/// A file of surfels or triangles that a scene names, with the settings for reading it.
struct PartFile {
  std::string path;
  SceneKind kind = SceneKind::file;
  std::shared_ptr<const SceneFile> scene{};    ///< contents if the file itself is a scene of parts
  MeaningOverride meaning;                     ///< units, axes and holes of the file
  std::string material, materials;             ///< name for every surfel; path of a table; or empty
  std::string material_field;                  ///< field of the cloud whose numbers mean materials; empty: none
  std::optional<Eigen::Vector3d> viewpoint{};  ///< position of the capture [m, in the axes of the file]
  double thin = 0;                             ///< distance of remaining surfels [m]; 0: all remain
  double spacing = 0;                          ///< distance of surfels of a mesh [m]; 0: follows from its size
  int line = 0;                                ///< line in the scene file
};

/// The contents of a [[part]].
struct ScenePartEntry {
  std::string name, label;  ///< label: as in the file; default: name of a placed part, empty for a captured part
  PartFile file;
  PartPlacement placement;
};

/// The contents of a [[scatter]].
struct SceneScatterEntry {
  std::vector<PartFile> files;
  std::vector<std::string> names, labels;  ///< one for each file
  ScatterRule rule;
  int line = 0;
};

/// A scene of parts as its file describes it.
struct SceneFile {
  std::string path, text;  ///< text: the whole file
  std::vector<ScenePartEntry> parts;
  std::vector<SceneScatterEntry> scatters;
  std::vector<std::string> trajectories;  ///< paths of the trajectories of parts
};

/// Returns a scene of parts from TOML (docs/scenes.md lists the keys), with the trajectories and the scenes of parts
/// that it names. Paths are relative to the file. Throws Error(file) if the file is missing. Throws Error(content) with
/// file, line and key for unknown keys, wrong types, a named file that is missing, a scene that contains itself, two
/// parts of one name, more than 65 000 parts, and bodies that do not fit into their area.
SceneFile load_scene_file(const std::string& path);

/// Returns the paths of all files of a scene: the scene file first, and also the files of scenes in it.
std::vector<std::string> files_of(const SceneFile& scene);

}  // namespace insonify
