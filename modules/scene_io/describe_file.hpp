// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "scene/material_shares.hpp"
#include "scene_io/file_meaning.hpp"

namespace insonify {

/// A kind of file of a scene, and what reads it in this build.
struct SceneFormat {
  std::vector<std::string> extensions;  ///< in lower case, with their dots
  std::string name;                     ///< such as "a PLY file"
  std::string package;                  ///< "insonify", "GDAL", "LASzip"; empty: none reads it in any build
  std::string remedy;                   ///< way to convert it if this build does not read it; else empty
};

/// Returns all kinds of files that are read, or refused with a remedy.
std::vector<SceneFormat> scene_formats();

/// Contents of a cloud or mesh file before preparation.
struct FileDescription {
  /// A column of the file.
  struct Field {
    std::string name, type;  ///< such as "x", "float32"
  };
  std::string path, format;
  std::string reader;  ///< library that read it, as SceneFormat::package
  std::size_t points = 0, triangles = 0, not_finite = 0, withheld = 0, duplicates = 0;
  std::size_t width = 0, height = 0;  ///< height > 1: organised
  std::vector<Field> fields;
  Eigen::Vector3d min = Eigen::Vector3d::Zero(), max = Eigen::Vector3d::Zero();  ///< box of usable points, world [m]
  double median_spacing = 0;                                                     ///< median distance of neighbours [m]
  bool has_normals = false, has_area = false, has_materials = false;
  std::optional<Eigen::Vector3d> viewpoint;  ///< place from which all points were seen [m]
  std::vector<Eigen::Vector3d> stations;     ///< places of the scanners of a cloud of several scans [m]
  /// Shares of the materials among the points that load_scene keeps, or among the corners of a mesh. The shares follow
  /// from the file's labels and areas; no areas are estimated. Empty without materials.
  std::vector<MaterialShare> materials;
  std::vector<MeaningItem> meaning;   ///< facts about the meaning of the numbers
  std::vector<std::string> problems;  ///< defects and doubts, each with a remedy
};

/// Returns the description of a cloud or mesh file; `requested` replaces its own meaning. Throws as load_scene.
FileDescription describe_file(const std::string& path, const MeaningOverride& requested = {});

}  // namespace insonify
