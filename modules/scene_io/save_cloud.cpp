// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/save_cloud.hpp"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <fstream>
#include <utility>

#include "core/error.hpp"
#include "files/input_file.hpp"
#include "files/pending_file.hpp"
#include "scene_io/packed_rows_internal.hpp"
#include "scene_io/row_file_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

static_assert(std::endian::native == std::endian::little, "save_cloud.cpp writes numbers in memory order");

namespace insonify {
namespace {

constexpr double farthest_in_pcd = 2000;  ///< [m]; float32 steps are 0.12 mm there

CloudFormat format_of(const std::string& path, const char* who) {
  const std::string extension = extension_of(path);
  if (extension == ".ply") return CloudFormat::ply;
  if (extension == ".pcd") return CloudFormat::pcd;
  fail(ErrorKind::argument, who, ": ", path, " has extension '", extension, "', must be .ply or .pcd");
}

/// Returns the format of a file for the scene, which must fit into it.
CloudFormat format_for(const std::string& path, const SceneCloud& scene) {
  const CloudFormat format = format_of(path, "save_scene");
  require_valid(scene, "save_scene");
  if (scene.size() == 0)
    fail(ErrorKind::content, "save_scene: ", path, ": the scene is empty, must hold at least one surfel");
  if (format == CloudFormat::pcd) {
    const Bounds box = bounds(scene);
    const double farthest = std::max(box.max.cwiseAbs().maxCoeff(), box.min.cwiseAbs().maxCoeff());
    if (farthest > farthest_in_pcd)
      fail(ErrorKind::argument, "save_scene: ", path, ": the scene reaches to ", farthest,
           " m from zero; a PCD is float32 and would lose more than 0.1 mm: save it as .ply");
  }
  return format;
}

void write_cloud(const std::string& path, CloudFormat format, const PackedRows& rows) {
  write_rows(path, format == CloudFormat::ply ? ply_header(rows) : pcd_header(rows), rows);
}

}  // namespace

void save_scene(const std::string& path, const SceneCloud& scene, const SceneColumns& columns) {
  const CloudFormat format = format_for(path, scene);
  write_cloud(path, format, rows_of(scene, format, columns));
}

void save_scene(const std::string& path, const LoadedScene& loaded) {
  if (loaded.mesh && !loaded.columns.heights && format_for(path, loaded.scene) == CloudFormat::ply)
    return write_cloud(path, CloudFormat::ply, rows_of(*loaded.mesh, loaded.corner_columns));
  if (!loaded.columns.heights || !loaded.mesh) return save_scene(path, loaded.scene, loaded.columns);
  SceneCloud scene = loaded.scene;
  scene.point = loaded.mesh->point;
  const CloudFormat format = format_for(path, scene);
  PackedRows rows = rows_of(scene, format, loaded.columns);
  if (format == CloudFormat::ply) rows.triangles = loaded.mesh->triangle;
  write_cloud(path, format, rows);
}

void save_mesh(const std::string& path, const SceneMesh& mesh) {
  if (extension_of(path) != ".ply")
    fail(ErrorKind::argument, "save_mesh: ", path, " has extension '", extension_of(path),
         "', must be .ply, which holds triangles and materials");
  require_valid(mesh, "save_mesh");
  if (mesh.triangle.empty()) fail(ErrorKind::content, "save_mesh: ", path, ": the mesh has no triangle");
  write_cloud(path, CloudFormat::ply, rows_of(mesh, SceneColumns{}));
}

void save_bare_points(const std::string& path, const SceneCloud& scene) {
  const CloudFormat format = format_for(path, scene);
  write_cloud(path, format, bare_rows_of(scene, format));
}

Eigen::Vector3d save_soundings(const std::string& path, const Soundings& soundings) {
  constexpr const char* who = "save_soundings";
  if (format_of(path, who) == CloudFormat::ply) {
    const PackedRows rows = rows_of(soundings, true, "scalar_", who);
    write_rows(path, ply_header(rows), rows);
    return Eigen::Vector3d::Zero();
  }
  const auto far = [](const Eigen::Vector3d& p) { return p.cwiseAbs().maxCoeff() > farthest_in_pcd; };
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  if (std::any_of(soundings.position.begin(), soundings.position.end(), far))
    origin = 100 * (soundings.position.front() / 100).array().round() + 0.0;  // turns -0 into 0
  const PackedRows rows = pcd_rows_of(soundings, origin, who);
  write_rows(path, pcd_header(rows), rows);
  return origin;
}

void save_survey_returns(const std::string& path, const Soundings& soundings, const std::vector<double>& time,
                         std::uint32_t head) {
  constexpr const char* who = "save_survey_returns";
  if (format_of(path, who) != CloudFormat::ply || time.size() != soundings.size())
    fail(ErrorKind::argument, who, ": ", path, " must be a .ply, with a time for each of the ", soundings.size(),
         " soundings");
  PackedRows rows = rows_of(soundings, true, "scalar_", who);
  rows.add("scalar_time", [&time](std::size_t i) { return time[i]; });
  rows.add("scalar_head", [head](std::size_t) { return head; });
  rows.comments.insert(rows.comments.end(), {"unit scalar_time s", "unit scalar_head number in the mission, from 0"});
  write_rows(path, ply_header(rows), rows);
}

void join_clouds(const std::string& path, const std::vector<std::string>& parts) {
  if (parts.empty()) fail(ErrorKind::argument, "join_clouds: ", path, ": no parts, must be at least one");
  // Take columns and comments of the first part, and the number of rows of all.
  PackedRows all;
  std::vector<RowFile> files;
  for (const std::string& part : parts) {
    RowFile file = rows_of_ply(part, "is not a binary little-endian PLY of points");
    if (files.empty()) {
      all.comments = file.comments;
      for (const auto& column : file.columns) all.columns.push_back({column.name, column.type});
    }
    if (!same_columns(file.columns, all.columns))
      fail(ErrorKind::content, part, ": has other columns than ", parts.front());
    all.rows += file.rows;
    files.push_back(std::move(file));
  }
  PendingFile pending(path);
  errno = 0;
  std::ofstream out(pending.temporary(), std::ios::binary);
  out << ply_header(all);
  for (const RowFile& file : files)
    each_batch(file, [&](const RowTable& rows) {
      out.write(rows.bytes, static_cast<std::streamsize>(rows.rows * rows.stride));
    });
  pending.commit(out);
}

void save_insonification(const std::string& path, const SceneCloud& scene, const std::vector<CoveredSurfel>& covered) {
  const CloudFormat format = format_of(path, "save_insonification");
  std::vector<std::uint32_t> ids = scene.id;
  std::sort(ids.begin(), ids.end());
  for (const CoveredSurfel& s : covered)
    if (!std::binary_search(ids.begin(), ids.end(), s.id))
      fail(ErrorKind::argument, "save_insonification: ", path, ": surfel ", s.id,
           " is not in the scene; give the coverage of this scene");
  write_cloud(path, format, rows_of(scene, covered, format));
}

}  // namespace insonify
