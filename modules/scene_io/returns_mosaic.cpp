#include "scene_io/returns_mosaic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/units.hpp"
#include "scene_io/file_probe_internal.hpp"
#include "scene_io/row_file_internal.hpp"

namespace insonify {
namespace {

/// x, y, level_db and range of every row, batch after batch.
template <typename Take>
void each_return(const RowFile& file, const Take& take) {
  std::array<const RowTable::Column*, 4> columns{};
  const char* names[] = {"x", "y", "scalar_level_db", "scalar_range"};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto found = std::find_if(file.columns.begin(), file.columns.end(),
                                    [&](const RowTable::Column& column) { return column.name == names[k]; });
    if (found == file.columns.end())
      fail(ErrorKind::content, file.path, ": has no column '", names[k], "', so it holds no returns");
    columns[k] = &*found;
  }
  constexpr std::size_t batch = 1 << 16;
  for (std::size_t first = 0; first < file.rows; first += batch) {
    const RowTable rows = read_rows(file, first, std::min(batch, file.rows - first));
    for (std::size_t i = 0; i < rows.rows; ++i) {
      const char* row = rows.bytes + i * rows.stride;
      take(columns[0]->value(row), columns[1]->value(row), columns[2]->value(row), columns[3]->value(row));
    }
  }
}

}  // namespace

ReturnsMosaic mosaic_of_returns(const std::string& path, double cell) {
  require_readable(path);
  const std::optional<RowFile> file = find_ply_rows(path);
  if (!file || file->big_endian || file->rows == 0) fail(ErrorKind::content, path, ": holds no returns");
  if (!(cell > 0 && std::isfinite(cell)))
    fail(ErrorKind::argument, "mosaic_of_returns: cell = ", cell, " m, must be > 0");

  // The extent in whole cells.
  constexpr double far = std::numeric_limits<double>::infinity();
  Eigen::Array2d low(far, far), high(-far, -far);
  each_return(*file, [&](double x, double y, double, double) {
    low = low.min(Eigen::Array2d(x, y));
    high = high.max(Eigen::Array2d(x, y));
  });
  low = (low / cell).floor();
  const Eigen::Array2d cells = (high / cell).floor() - low + 1;
  if (!(cells.prod() <= 0x1p26))
    fail(ErrorKind::argument, "mosaic_of_returns: cell = ", cell, " m makes ", cells.x(), " x ", cells.y(),
         " cells, must be at most 2^26");

  ReturnsMosaic mosaic{low.x() * cell, low.y() * cell, cell, {}, {}};
  const Eigen::Array2i size = cells.cast<int>();
  mosaic.returns = Grid<float>::Zero(size.x(), size.y());
  Grid<double> intensity = Grid<double>::Zero(size.x(), size.y());
  each_return(*file, [&](double x, double y, double level_db, double range) {
    const Eigen::Array2i at = ((Eigen::Array2d(x, y) / cell).floor() - low).cast<int>();
    intensity(at.x(), at.y()) += power_from_db(level_db + 30 * std::log10(range));
    mosaic.returns(at.x(), at.y()) += 1;
  });
  mosaic.level_db = (10 * (intensity / mosaic.returns.cast<double>()).log10()).cast<float>();  // 0 / 0 is NaN
  return mosaic;
}

}  // namespace insonify
