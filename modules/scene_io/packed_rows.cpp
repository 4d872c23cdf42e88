// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <limits>

#include "core/error.hpp"
#include "core/units.hpp"
#include "returns/sounding_columns.hpp"
#include "scene_io/packed_rows_internal.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/scene_columns_internal.hpp"

namespace insonify {
namespace {

void put_position(char*& out, const Eigen::Vector3d& position, bool wide) {
  for (const double coordinate : position) {
    if (wide)
      put(out, coordinate);
    else
      put(out, static_cast<float>(coordinate));
  }
}

void add_columns(PackedRows& rows, const std::string& prefix, std::initializer_list<const char*> names,
                 NumberType type) {
  for (const char* name : names) rows.columns.push_back({prefix + name, type});
}

/// What a PLY calls a type. Open3D skips columns of uint and ushort: uint32 is "int", whose bits are the same.
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

PackedRows rows_of(const Soundings& soundings, bool wide, const std::string& prefix, const char* who) {
  const std::size_t n = soundings.size();
  const bool ply = !prefix.empty();
  PackedRows rows;
  rows.rows = n;
  add_columns(rows, "", {"x", "y", "z"}, wide ? NumberType::float64 : NumberType::float32);
  for (const char* axis : {"x", "y", "z"}) rows.comments.push_back(std::string("unit ") + axis + " m");
  each_column(
      [&](const SoundingColumn& about, const auto& column) {
        if (column.size() != n)
          fail(ErrorKind::argument, who, ": soundings have ", n, " positions but a column of length ", column.size(),
               ", must be the same; fill every column");
        const bool real = std::is_same_v<decltype(column.front()), const float&>;
        rows.columns.push_back({prefix + about.name, real ? NumberType::float32 : NumberType::uint32});
        rows.comments.push_back("unit " + prefix + about.name + " " + (ply ? signed_unit(about) : about.unit));
      },
      soundings);
  rows.write_row = [&soundings, wide](std::size_t i, char* out) {
    put_position(out, soundings.position[i], wide);
    each_column([&](const SoundingColumn&, const auto& column) { put(out, column[i]); }, soundings);
  };
  return rows;
}

PackedRows pcd_rows_of(const Soundings& soundings, const Eigen::Vector3d& origin, const char* who) {
  PackedRows rows = rows_of(soundings, false, "", who);
  rows.origin = origin;
  rows.columns.push_back({"intensity", NumberType::float32});
  rows.columns.push_back({"label", NumberType::uint32});
  rows.comments.emplace_back("intensity is level_db, label is true_material");
  const std::size_t last = rows.stride() - sizeof(float) - sizeof(std::uint32_t);
  rows.write_row = [&soundings, origin, last, write_row = rows.write_row](std::size_t i, char* out) {
    write_row(i, out);
    char* place = out;
    put_position(place, soundings.position[i] - origin, false);
    out += last;
    put(out, soundings.level_db[i]);
    put(out, soundings.true_material[i]);
  };
  return rows;
}

PackedRows bare_rows_of(const SceneCloud& scene, CloudFormat format) {
  const bool wide = format == CloudFormat::ply && !scene.origin.isZero(0);
  PackedRows rows;
  rows.rows = scene.size();
  add_columns(rows, "", {"x", "y", "z"}, wide ? NumberType::float64 : NumberType::float32);
  rows.write_row = [&scene, wide](std::size_t i, char* out) {
    put_position(out, scene.origin + scene.point[i].cast<double>(), wide);
  };
  return rows;
}

PackedRows rows_of(const SceneCloud& scene, CloudFormat format, const SceneColumns& columns) {
  const bool ply = format == CloudFormat::ply;
  const bool wide = ply && !scene.origin.isZero(0);
  PackedRows rows;
  rows.rows = scene.size();
  rows.comments = tag_lines(scene);
  add_columns(rows, "", {"x", "y", "z"}, wide ? NumberType::float64 : NumberType::float32);
  add_columns(rows, ply ? "n" : "normal_", {"x", "y", "z"}, NumberType::float32);
  rows.columns.push_back({"area", NumberType::float32});
  rows.columns.push_back({"", NumberType::uint32});  // named below
  // An int ends at 2^31 - 1; a double holds every id.
  const bool long_ids = ply && std::any_of(scene.id.begin(), scene.id.end(), [](auto id) { return id > 2147483647; });
  rows.columns.push_back({"id", long_ids ? NumberType::float64 : NumberType::uint32});
  if (!scene.noise.empty()) rows.columns.push_back({"noise", NumberType::float32});
  rows.write_row = [&scene, wide, long_ids](std::size_t i, char* out) {
    put_position(out, scene.origin + scene.point[i].cast<double>(), wide);
    for (const float n : scene.normal[i]) put(out, n);
    put(out, scene.area[i]);
    put(out, std::uint32_t{scene.material[i]});
    if (long_ids)
      put(out, static_cast<double>(scene.id[i]));
    else
      put(out, scene.id[i]);
    if (!scene.noise.empty()) put(out, scene.noise[i]);
  };
  add_columns(rows, columns, format);
  if (columns.heights)
    rows.comments.push_back(std::string("insonify points heights") + (columns.own_normals ? " normals" : ""));
  return rows;
}

PackedRows rows_of(const SceneMesh& mesh, const SceneColumns& columns) {
  const bool wide = !mesh.origin.isZero(0);
  SceneCloud tagged;
  tagged.origin = mesh.origin;
  tagged.materials = mesh.materials;
  tagged.normals_oriented = mesh.normals_oriented;
  PackedRows rows;
  rows.rows = mesh.point.size();
  rows.comments = tag_lines(tagged);
  add_columns(rows, "", {"x", "y", "z"}, wide ? NumberType::float64 : NumberType::float32);
  if (!mesh.normal.empty()) add_columns(rows, "n", {"x", "y", "z"}, NumberType::float32);
  rows.columns.push_back({"", NumberType::uint32});  // named below
  rows.write_row = [&mesh, wide](std::size_t i, char* out) {
    put_position(out, mesh.origin + mesh.point[i].cast<double>(), wide);
    if (!mesh.normal.empty())
      for (const float n : mesh.normal[i]) put(out, n);
    put(out, std::uint32_t{mesh.material[i]});
  };
  rows.triangles = mesh.triangle;
  add_columns(rows, columns, CloudFormat::ply);
  return rows;
}

PackedRows rows_of(const SceneCloud& scene, const std::vector<CoveredSurfel>& covered, CloudFormat format) {
  const bool ply = format == CloudFormat::ply;
  const bool wide = ply && !scene.origin.isZero(0);
  const std::string prefix = ply ? "scalar_" : "";
  PackedRows rows;
  rows.rows = scene.size();
  add_columns(rows, "", {"x", "y", "z"}, wide ? NumberType::float64 : NumberType::float32);
  add_columns(rows, ply ? "n" : "normal_", {"x", "y", "z"}, NumberType::float32);
  add_columns(rows, prefix, {"level_db", "scattering_db", "cell_level_db", "grazing_deg", "range"},
              NumberType::float32);
  add_columns(rows, prefix, {"hits", "material", "id"}, NumberType::uint32);
  rows.write_row = [&scene, &covered, wide](std::size_t i, char* out) {
    constexpr float never = std::numeric_limits<float>::quiet_NaN();
    const auto at = std::lower_bound(covered.begin(), covered.end(), scene.id[i],
                                     [](const CoveredSurfel& s, std::uint32_t id) { return s.id < id; });
    const bool there = at != covered.end() && at->id == scene.id[i];
    put_position(out, scene.origin + scene.point[i].cast<double>(), wide);
    for (const float n : scene.normal[i]) put(out, n);
    for (const float CoveredSurfel::*level :
         {&CoveredSurfel::level_db, &CoveredSurfel::scattering_db, &CoveredSurfel::cell_level_db})
      put(out, there ? *at.*level : never);
    put(out, there ? static_cast<float>(degrees(at->grazing_angle)) : never);
    put(out, there ? at->range : never);
    put(out, there ? at->pings : 0);
    put(out, std::uint32_t{scene.material[i]});
    put(out, scene.id[i]);
  };
  return rows;
}

}  // namespace insonify
