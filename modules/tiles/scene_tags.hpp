// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "scene/scene_cloud.hpp"

// Facts about a scene that prepared files hold as lines of text: comments of PLY and PCD, an attribute of .tiles.
namespace insonify {

/// The facts in save_scene's comment lines, with which a prepared scene reads back unchanged.
struct SceneTags {
  bool prepared = false;  ///< written by save_scene: clean, complete, unique
  bool oriented = true;
  std::optional<Eigen::Vector3d> origin;
  std::vector<Material> materials;
  std::string material_field;  ///< name of the column of materials; empty: not stated
  std::string system;          ///< coordinate system of the world; empty: not stated
  bool heights = false;        ///< true: points of a height field, with the surface between them
  bool own_normals = false;    ///< true: the surface has the normals of the points
  std::string levels_of;       ///< TiledSceneInfo::levels_of
  std::vector<std::pair<std::string, std::string>> columns;  ///< name in the file, and the name that it stands for

  /// Returns the name that a column of the file stands for: its own unless the file names another.
  const std::string& meant_name(const std::string& in_file) const;
  /// Returns the name in the file of the column that stands for `meant`.
  const std::string& name_in_file(const std::string& meant) const;
};

/// Returns a text as JSON in ASCII characters.
std::string json_text(const std::string& text);
/// Returns a text as valid UTF-8; unchanged if it is that already.
std::string utf8_text(const std::string& text);

/// Parses a comment line (without its "comment " or "# ") if save_scene wrote it; `path` is used in messages.
void read_tag(const std::string& path, std::string_view line, SceneTags& tags);
/// Returns the comment lines of a scene in a coordinate system (empty: unknown), without "comment " or "# ".
std::vector<std::string> tag_lines(const SceneCloud& scene, const std::string& system);

}  // namespace insonify
