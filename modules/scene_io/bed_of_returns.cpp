// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/bed_of_returns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "returns/soundings.hpp"
#include "scene_io/row_file_internal.hpp"

namespace insonify {
namespace {

RowFile returns_file(const std::string& path) {
  RowFile file = rows_of_ply(path, "holds no returns");
  if (file.rows == 0) fail(ErrorKind::content, path, ": holds no returns");
  return file;
}

/// Passes on place, level and range of every row that comes from a surfel. False alarms do not, and lie on no bed.
template <typename Take>
void each_return(const RowFile& file, const Take& take) {
  constexpr std::array<const char*, 6> names = {"x", "y", "z", "scalar_level_db", "scalar_range", "scalar_true_surfel"};
  std::array<const RowTable::Column*, 6> columns{};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    columns[k] = column_named(file.columns, names[k]);
    if (!columns[k]) fail(ErrorKind::content, file.path, ": has no column '", names[k], "', so it holds no returns");
  }
  each_batch(file, [&](const RowTable& rows) {
    for (std::size_t i = 0; i < rows.rows; ++i) {
      const char* row = rows.bytes + i * rows.stride;
      const auto value = [&](std::size_t k) { return columns[k]->value(row); };
      if (value(5) == Soundings::none || value(5) == -1) continue;  // no surfel, in older files and in new ones
      take(Eigen::Vector3d(value(0), value(1), value(2)), value(3), value(4));
    }
  });
}

Eigen::AlignedBox2d extent_of(const RowFile& file) {
  Eigen::AlignedBox2d box;
  each_return(
      file, [&](const Eigen::Vector3d& position, double, double) { box.extend(Eigen::Vector2d(position.head<2>())); });
  if (box.isEmpty()) fail(ErrorKind::content, file.path, ": holds no returns of surfels");
  return box;
}

}  // namespace

BedSurface bed_of_returns(const std::string& path, double cell) {
  const RowFile file = returns_file(path);
  const Eigen::AlignedBox2d box = extent_of(file);
  BedPoints points(box.min(), box.max(), cell);
  each_return(file, [&](const Eigen::Vector3d& position, double, double) { points.add(position); });
  return points.surface();
}

ReturnsMap map_of_returns(const std::string& path, int cells) {
  const RowFile file = returns_file(path);
  const Eigen::AlignedBox2d box = extent_of(file);
  ReturnsMap map{box.min().x(), box.min().y(), std::max(1e-3, box.sizes().maxCoeff() / cells), {}};
  const Eigen::Array2i size = (box.sizes() / map.cell).array().floor().cast<int>() + 1;
  map.level_db.setConstant(size.x(), size.y(), std::numeric_limits<float>::quiet_NaN());
  each_return(file, [&](const Eigen::Vector3d& position, double level_db, double range) {
    const Eigen::Array2i at = ((position.head<2>() - box.min()) / map.cell).array().floor().cast<int>();
    float& level = map.level_db(at.x(), at.y());
    level = std::fmax(level, static_cast<float>(level_db + 40 * std::log10(range)));  // takes the other number for NaN
  });
  return map;
}

}  // namespace insonify
