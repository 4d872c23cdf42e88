// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <memory>

#include "core/error.hpp"
#include "core/units.hpp"
#include "returns/sounding_columns.hpp"
#include "scene_io/packed_rows_internal.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/scene_columns_internal.hpp"

namespace insonify {
namespace {

void add_normals(PackedRows& rows, const std::string& prefix, const std::vector<Eigen::Vector3f>& normals) {
  for (int axis = 0; axis < 3; ++axis)
    rows.add(prefix + "xyz"[axis], [&normals, axis](std::size_t i) { return normals[i][axis]; });
}

/// Adds the columns x y z of a scene or mesh: double in a PLY, unless the origin is zero.
template <typename Scene>
void add_points(PackedRows& rows, const Scene& scene, CloudFormat format) {
  rows.rows = scene.point.size();
  add_positions(
      rows, format == CloudFormat::ply && !scene.origin.isZero(0),
      [&scene](std::size_t i) -> Eigen::Vector3d { return scene.origin + scene.point[i].template cast<double>(); });
}

/// Adds the column of the materials of a scene or mesh.
template <typename Scene>
void add_material(PackedRows& rows, const std::string& name, const Scene& scene) {
  rows.add(name, [&scene](std::size_t i) { return std::uint32_t{scene.material[i]}; });
}

/// Returns PLY's name of a type. Open3D skips columns of uint and ushort: uint32 is "int", whose bits are the same.
const char* ply_type(NumberType type) {
  constexpr std::array<const char*, 10> names = {"char", "uchar",  "short",  "ushort", "int",
                                                 "int",  "double", "double", "float",  "double"};
  return names[static_cast<std::size_t>(type)];
}

}  // namespace

std::string ply_header(const PackedRows& rows) {
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& comment : rows.comments) header += "comment " + comment + "\n";
  header += "element vertex " + std::to_string(rows.rows) + "\n";
  for (const PackedRows::Column& column : rows.columns) {
    const char* type = ply_type(column.type);
    header += std::string("property ") + type + " " + column.name + "\n";
  }
  if (!rows.triangles.empty())
    header += "element face " + std::to_string(rows.triangles.size()) + "\nproperty list uchar int vertex_indices\n";
  return header + "end_header\n";
}

PackedRows rows_of(const Soundings& soundings, bool wide, const std::string& prefix, const char* who,
                   const Eigen::Vector3d& origin) {
  const std::size_t n = soundings.size();
  PackedRows rows;
  rows.rows = n;
  add_positions(rows, wide,
                [&soundings, origin](std::size_t i) -> Eigen::Vector3d { return soundings.position[i] - origin; });
  for (const char* axis : {"x", "y", "z"}) rows.comments.push_back(std::string("unit ") + axis + " m");
  each_column(
      [&](const SoundingColumn& about, const auto& column) {
        if (column.size() != n)
          fail(ErrorKind::argument, who, ": soundings have ", n, " positions but a column of length ", column.size(),
               ", must be the same; fill every column");
        rows.add(prefix + about.name, [&column](std::size_t i) { return column[i]; });
        rows.comments.push_back("unit " + prefix + about.name + " " +
                                (prefix.empty() ? about.unit : signed_unit(about)));
      },
      soundings);
  return rows;
}

PackedRows pcd_rows_of(const Soundings& soundings, const Eigen::Vector3d& origin, const char* who) {
  PackedRows rows = rows_of(soundings, false, "", who, origin);
  rows.origin = origin;
  rows.add("intensity", [&soundings](std::size_t i) { return soundings.level_db[i]; });
  rows.add("label", [&soundings](std::size_t i) { return soundings.true_material[i]; });
  rows.comments.emplace_back("intensity is level_db, label is true_material");
  return rows;
}

PackedRows bare_rows_of(const SceneCloud& scene, CloudFormat format) {
  PackedRows rows;
  add_points(rows, scene, format);
  return rows;
}

PackedRows rows_of(const SceneCloud& scene, CloudFormat format, const SceneColumns& columns) {
  const bool ply = format == CloudFormat::ply;
  PackedRows rows;
  rows.comments = tag_lines(scene, columns.system);
  add_points(rows, scene, format);
  add_normals(rows, ply ? "n" : "normal_", scene.normal);
  rows.add("area", [&scene](std::size_t i) { return scene.area[i]; });
  add_material(rows, "", scene);  // named below
  // The largest int is 2^31 - 1; a double holds every id.
  if (ply && std::any_of(scene.id.begin(), scene.id.end(), [](auto id) { return id > 2147483647; }))
    rows.add("id", [&scene](std::size_t i) { return static_cast<double>(scene.id[i]); });
  else
    rows.add("id", [&scene](std::size_t i) { return scene.id[i]; });
  if (!scene.noise.empty()) rows.add("noise", [&scene](std::size_t i) { return scene.noise[i]; });
  add_columns(rows, columns, format);
  if (columns.heights)
    rows.comments.push_back(std::string("insonify points heights") + (columns.own_normals ? " normals" : ""));
  return rows;
}

PackedRows rows_of(const SceneMesh& mesh, const SceneColumns& columns) {
  SceneCloud tagged;
  tagged.origin = mesh.origin;
  tagged.materials = mesh.materials;
  tagged.normals_oriented = mesh.normals_oriented;
  PackedRows rows;
  rows.comments = tag_lines(tagged, columns.system);
  add_points(rows, mesh, CloudFormat::ply);
  if (!mesh.normal.empty()) add_normals(rows, "n", mesh.normal);
  add_material(rows, "", mesh);  // named below
  rows.triangles = mesh.triangle;
  add_columns(rows, columns, CloudFormat::ply);
  return rows;
}

PackedRows rows_of(const SceneCloud& scene, const std::vector<CoveredSurfel>& covered, CloudFormat format) {
  const bool ply = format == CloudFormat::ply;
  const std::string prefix = ply ? "scalar_" : "";
  PackedRows rows;
  add_points(rows, scene, format);
  add_normals(rows, ply ? "n" : "normal_", scene.normal);
  const auto found = std::make_shared<std::vector<const CoveredSurfel*>>(scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const auto at = std::lower_bound(covered.begin(), covered.end(), scene.id[i],
                                     [](const CoveredSurfel& s, std::uint32_t id) { return s.id < id; });
    if (at != covered.end() && at->id == scene.id[i]) (*found)[i] = &*at;
  }
  const auto add = [&](const char* name, auto value, auto never) {
    rows.add(prefix + name, [=](std::size_t i) { return (*found)[i] ? std::invoke(value, *(*found)[i]) : never; });
  };
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  add("level_db", &CoveredSurfel::level_db, nan);
  add("scattering_db", &CoveredSurfel::scattering_db, nan);
  add("cell_level_db", &CoveredSurfel::cell_level_db, nan);
  add(
      "grazing_deg", [](const CoveredSurfel& s) { return static_cast<float>(degrees(s.grazing_angle)); }, nan);
  add("range", &CoveredSurfel::range, nan);
  add("hits", &CoveredSurfel::pings, std::uint32_t{0});
  add_material(rows, prefix + "material", scene);
  rows.add(prefix + "id", [&scene](std::size_t i) { return scene.id[i]; });
  return rows;
}

}  // namespace insonify
