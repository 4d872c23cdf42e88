// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "returns/coverage.hpp"
#include "returns/soundings.hpp"
#include "scene/scene_mesh.hpp"
#include "scene_io/number_type_internal.hpp"
#include "scene_io/scene_columns.hpp"

// Private to scene_io: a cloud as rows of packed little-endian numbers, the data section of binary PLY and PCD.
namespace insonify {

struct PackedRows {
  struct Column {
    std::string name;
    NumberType type;
    /// Writes the numbers of `count` rows from `first` on, `stride` bytes apart.
    std::function<void(std::size_t first, std::size_t count, char* out, std::size_t stride)> write{};
  };
  std::vector<Column> columns;
  std::size_t rows = 0;
  std::vector<std::string> comments;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();           ///< origin of a PCD [m], which becomes its VIEWPOINT
  std::span<const std::array<std::uint32_t, 3>> triangles{};  ///< rows that are corners of triangles, in a PLY

  /// Adds a column of the numbers value(row), of their type.
  template <typename Value>
  void add(const std::string& name, Value value) {
    using Number = std::decay_t<decltype(value(std::size_t{}))>;
    columns.push_back(
        {name, type_of_number<Number>(), [value](std::size_t first, std::size_t count, char* out, std::size_t stride) {
           for (std::size_t i = first; i < first + count; ++i, out += stride) {
             const Number number = value(i);
             std::memcpy(out, &number, sizeof number);
           }
         }});
  }

  std::size_t stride() const {
    std::size_t bytes = 0;
    for (const Column& c : columns) bytes += size_of(c.type);
    return bytes;
  }

  /// Writes `count` rows from `first` on.
  void write(std::size_t first, std::size_t count, char* out) const {
    const std::size_t row = stride();
    for (const Column& c : columns) c.write(first, count, out, row), out += size_of(c.type);
  }
};

/// Returns true if columns have the same names and their numbers the same bits. A PLY calls a uint32 int; older files
/// call it uint.
template <typename Columns, typename Others>
bool same_columns(const Columns& columns, const Others& others) {
  const auto bits = [](NumberType type) { return type == NumberType::int32 ? NumberType::uint32 : type; };
  return std::equal(columns.begin(), columns.end(), others.begin(), others.end(),
                    [&](const auto& a, const auto& b) { return a.name == b.name && bits(a.type) == bits(b.type); });
}

/// Copies a number to `out` and advances `out`.
template <typename T>
void put(char*& out, T value) {
  std::memcpy(out, &value, sizeof(T));
  out += sizeof(T);
}

/// Adds the columns x y z of place(row): double if `wide`, else float32.
template <typename Position>
void add_positions(PackedRows& rows, bool wide, const Position& position) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    if (wide)
      rows.add(name, [position, axis](std::size_t i) -> double { return position(i)[axis]; });
    else
      rows.add(name, [position, axis](std::size_t i) { return static_cast<float>(position(i)[axis]); });
  }
}

/// Returns the columns x y z less an origin (double if `wide`), level_db range azimuth elevation (float32), ping beam
/// bin (uint32), true_elevation (float32), true_surfel true_material (uint32; -1 in a PLY for none). All names but x y
/// z begin with `prefix`, which a PLY has. Throws Error(argument) unless all columns have one length.
PackedRows rows_of(const Soundings& soundings, bool wide, const std::string& prefix, const char* who,
                   const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// Returns the rows of soundings for a PCD: float32 less an origin, with intensity (level_db, float32) and label
/// (true_material, uint32), the names of PCL's own point types.
PackedRows pcd_rows_of(const Soundings& soundings, const Eigen::Vector3d& origin, const char* who);

enum class CloudFormat { ply, pcd };
/// Returns x y z (in PLY double unless the origin is zero), normal, area (float32), material, id (uint32; in PLY
/// float64 if one is above 2147483647), noise (float32) if the scene has it, then the other columns.
PackedRows rows_of(const SceneCloud& scene, CloudFormat format, const SceneColumns& columns = {});
/// Returns triangles and corners of a mesh for a PLY: x y z (double unless the origin is zero), normal (float32) if it
/// has normals, material, then the other columns, one number a corner. Keeps references to both arguments.
PackedRows rows_of(const SceneMesh& mesh, const SceneColumns& columns);
/// Returns only the columns x y z of a scene.
PackedRows bare_rows_of(const SceneCloud& scene, CloudFormat format);

/// Returns the columns x y z (double in PLY unless the origin is zero), normal, level_db, grazing_deg, range (float32;
/// NaN where no ping insonified), hits, material, id (uint32). From level_db on, names in PLY are scalar_ + name.
/// `covered` has ascending ids.
PackedRows rows_of(const SceneCloud& scene, const std::vector<CoveredSurfel>& covered, CloudFormat format);

/// Returns the header of a binary little-endian PLY. Columns of uint32 are "int", which every reader takes.
std::string ply_header(const PackedRows& rows);

/// Returns the header of a binary PCD with its DATA line (written by PCL). Comments become "# " lines.
std::string pcd_header(const PackedRows& rows);

/// Writes header and rows to a temporary file, then renames it to `path`; leaves nothing behind on failure.
void write_rows(const std::string& path, const std::string& header, const PackedRows& rows);

}  // namespace insonify
