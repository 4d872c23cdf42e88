#include "scene_io/bed_of_returns.hpp"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "scene_io/file_probe_internal.hpp"
#include "scene_io/row_file_internal.hpp"

namespace insonify {
namespace {

/// The place of every row, batch after batch.
template <typename Take>
void each_place(const RowFile& file, const Take& take) {
  std::array<const RowTable::Column*, 3> columns{};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto found = std::find_if(file.columns.begin(), file.columns.end(), [&](const RowTable::Column& column) {
      return column.name == std::string(1, "xyz"[k]);
    });
    if (found == file.columns.end()) fail(ErrorKind::content, file.path, ": has no column '", "xyz"[k], "'");
    columns[k] = &*found;
  }
  constexpr std::size_t batch = 1 << 16;
  for (std::size_t first = 0; first < file.rows; first += batch) {
    const RowTable rows = read_rows(file, first, std::min(batch, file.rows - first));
    for (std::size_t i = 0; i < rows.rows; ++i) {
      const char* row = rows.bytes + i * rows.stride;
      take(Eigen::Vector3d(columns[0]->value(row), columns[1]->value(row), columns[2]->value(row)));
    }
  }
}

}  // namespace

BedSurface bed_of_returns(const std::string& path, double cell) {
  require_readable(path);
  const std::optional<RowFile> file = find_ply_rows(path);
  if (!file || file->big_endian || file->rows == 0) fail(ErrorKind::content, path, ": holds no returns");
  Eigen::AlignedBox2d box;
  each_place(*file, [&](const Eigen::Vector3d& place) { box.extend(Eigen::Vector2d(place.head<2>())); });
  BedPoints points(box.min(), box.max(), cell);
  each_place(*file, [&](const Eigen::Vector3d& place) { points.add(place); });
  return points.surface();
}

}  // namespace insonify
