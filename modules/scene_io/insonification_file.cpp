// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/insonification_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "core/error.hpp"
#include "files/input_file.hpp"
#include "scene_io/packed_rows_internal.hpp"
#include "scene_io/row_file_internal.hpp"
#include "scene_io/write_rows_internal.hpp"

namespace insonify {
namespace {

/// The columns after the coordinates, which are float or double.
const std::vector<PackedRows::Column>& map_columns() {
  static const std::vector<PackedRows::Column> columns = [] {
    std::vector<PackedRows::Column> all = rows_of(SceneCloud{}, std::vector<CoveredSurfel>{}, CloudFormat::ply).columns;
    return std::vector(all.begin() + 3, all.end());
  }();
  return columns;
}

std::size_t offset_of(const std::string& name) {
  std::size_t offset = 0;
  for (const PackedRows::Column& column : map_columns()) {
    if (column.name == name) return offset;
    offset += size_of(column.type);
  }
  fail(ErrorKind::runtime, "insonification has no column ", name);
}

/// The map of one or more pings: rows of a file, in memory.
class MapRows {
 public:
  explicit MapRows(const std::string& path) {
    require_readable(path);
    std::optional<RowFile> file = find_ply_rows(path);
    const auto same = [](const auto& a, const auto& b) { return same_column(a, b); };
    if (!file || file->big_endian || file->columns.size() != map_columns().size() + 3 ||
        !std::equal(map_columns().begin(), map_columns().end(), file->columns.begin() + 3, same))
      fail(ErrorKind::content, path, ": is not an insonification.ply of a ping");
    wide_ = file->columns.front().type == NumberType::float64;
    stride_ = file->stride;
    const RowTable rows = read_rows(*file, 0, file->rows);
    bytes_.assign(rows.bytes, rows.bytes + file->rows * stride_);
  }
  std::size_t rows() const { return bytes_.size() / stride_; }
  bool wide() const { return wide_; }
  const char* row(std::size_t i) const { return bytes_.data() + i * stride_; }
  std::size_t stride() const { return stride_; }

  /// Whether `other` is of the same scene: as many surfels, at the same places.
  bool same_scene(const MapRows& other) const {
    if (bytes_.size() != other.bytes_.size() || wide_ != other.wide_) return false;
    const std::size_t place = coordinates();
    for (std::size_t i = 0; i < rows(); ++i)
      if (std::memcmp(row(i), other.row(i), place) != 0) return false;
    return true;
  }
  /// Adds the pings of `other`.
  void add(const MapRows& other) {
    static const std::size_t hits = offset_of("scalar_hits"), range = offset_of("scalar_range");
    static const std::size_t highest[] = {offset_of("scalar_level_db"), offset_of("scalar_scattering_db"),
                                          offset_of("scalar_cell_level_db"), offset_of("scalar_grazing_deg")};
    for (std::size_t i = 0; i < rows(); ++i) {
      char* mine = bytes_.data() + i * stride_ + coordinates();
      const char* its = other.row(i) + coordinates();
      for (const std::size_t column : highest)
        join<float>(mine + column, its + column, [](float a, float b) { return std::fmax(a, b); });
      join<float>(mine + range, its + range, [](float a, float b) { return std::fmin(a, b); });
      join<std::uint32_t>(mine + hits, its + hits, [](std::uint32_t a, std::uint32_t b) { return a + b; });
    }
  }

 private:
  std::size_t coordinates() const { return wide_ ? 24 : 12; }
  /// Of numbers one of which may be NaN, where no ping insonified the surfel, fmax and fmin take the other.
  template <typename Number, typename Rule>
  static void join(char* mine, const char* its, const Rule& rule) {
    const Number joined = rule(read_as<Number>(mine), read_as<Number>(its));
    std::memcpy(mine, &joined, sizeof joined);
  }

  bool wide_ = false;
  std::size_t stride_ = 0;
  std::vector<char> bytes_;
};

/// The rows of a map as one of the two formats.
PackedRows rows_of(const MapRows& map, CloudFormat format) {
  PackedRows rows = rows_of(SceneCloud{}, std::vector<CoveredSurfel>{}, format);
  const bool wide = map.wide() && format == CloudFormat::ply;
  for (std::size_t k = 0; k < 3; ++k) rows.columns[k].type = wide ? NumberType::float64 : NumberType::float32;
  rows.rows = map.rows();
  rows.write_row = [&map, wide](std::size_t i, char* out) {
    const char* row = map.row(i);
    for (int k = 0; k < 3; ++k) {
      if (map.wide() && !wide)
        put(out, static_cast<float>(read_as<double>(row + 8 * k)));
      else if (wide)
        put(out, read_as<double>(row + 8 * k));
      else
        put(out, read_as<float>(row + 4 * k));
    }
    const std::size_t before = map.wide() ? 24 : 12;
    std::memcpy(out, row + before, map.stride() - before);
  };
  return rows;
}

}  // namespace

bool join_insonification(const std::string& ply, const std::string& pcd, const std::vector<std::string>& parts) {
  if (parts.empty()) fail(ErrorKind::argument, "join_insonification: ", ply, ": no parts, must be at least one");
  MapRows sum(parts.front());
  for (auto part = parts.begin() + 1; part != parts.end(); ++part) {
    const MapRows next(*part);
    if (!sum.same_scene(next)) return false;
    sum.add(next);
  }
  const PackedRows as_ply = rows_of(sum, CloudFormat::ply), as_pcd = rows_of(sum, CloudFormat::pcd);
  write_rows(ply, ply_header(as_ply), as_ply);
  write_rows(pcd, pcd_header(as_pcd), as_pcd);
  return true;
}

}  // namespace insonify
