// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/insonification_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>

#include "core/error.hpp"
#include "scene_io/packed_rows_internal.hpp"
#include "scene_io/row_file_internal.hpp"

namespace insonify {
namespace {

/// Returns the columns after the coordinates.
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

/// The map of one or more pings: the rows of a file in memory.
class MapRows {
 public:
  explicit MapRows(const std::string& path) {
    const char* const otherwise = "is not an insonification.ply of a ping";
    const RowFile file = rows_of_ply(path, otherwise);
    if (file.columns.size() < 3 || !same_columns(std::span(file.columns).subspan(3), map_columns()))
      fail(ErrorKind::content, path, ": ", otherwise);
    wide_ = file.columns.front().type == NumberType::float64;
    stride_ = file.stride;
    const RowTable rows = read_rows(file, 0, file.rows);
    bytes_.assign(rows.bytes, rows.bytes + file.rows * stride_);
  }
  std::size_t rows() const { return bytes_.size() / stride_; }
  bool wide() const { return wide_; }
  const char* row(std::size_t i) const { return bytes_.data() + i * stride_; }
  Eigen::Vector3d position(std::size_t i) const {
    if (wide_) return Eigen::Vector3d(read_as<std::array<double, 3>>(row(i)).data());
    return Eigen::Vector3f(read_as<std::array<float, 3>>(row(i)).data()).cast<double>();
  }

  /// Returns true if `other` is of the same scene: as many surfels, at the same positions.
  bool same_scene(const MapRows& other) const {
    if (bytes_.size() != other.bytes_.size() || wide_ != other.wide_) return false;
    const std::size_t position = coordinates();
    for (std::size_t i = 0; i < rows(); ++i)
      if (std::memcmp(row(i), other.row(i), position) != 0) return false;
    return true;
  }
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
  /// Joins numbers by fmax or fmin, which take the other number for NaN; NaN means that no ping insonified the surfel.
  template <typename Number, typename Rule>
  static void join(char* mine, const char* its, const Rule& rule) {
    const Number joined = rule(read_as<Number>(mine), read_as<Number>(its));
    std::memcpy(mine, &joined, sizeof joined);
  }

  bool wide_ = false;
  std::size_t stride_ = 0;
  std::vector<char> bytes_;
};

PackedRows rows_of(const MapRows& map, CloudFormat format) {
  PackedRows rows = rows_of(SceneCloud{}, std::vector<CoveredSurfel>{}, format);
  PackedRows positions;
  add_positions(positions, map.wide() && format == CloudFormat::ply, [&map](std::size_t i) { return map.position(i); });
  std::move(positions.columns.begin(), positions.columns.end(), rows.columns.begin());
  rows.rows = map.rows();
  std::size_t at = map.wide() ? 24 : 12;
  for (auto column = rows.columns.begin() + 3; column != rows.columns.end(); ++column) {
    column->write = [&map, at, size = size_of(column->type)](std::size_t first, std::size_t count, char* out,
                                                             std::size_t stride) {
      for (std::size_t i = first; i < first + count; ++i, out += stride) std::memcpy(out, map.row(i) + at, size);
    };
    at += size_of(column->type);
  }
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
