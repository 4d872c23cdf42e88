#include <algorithm>

#include "core/error.hpp"
#include "returns/sounding_columns.hpp"
#include "scene_io/file_probe_internal.hpp"
#include "scene_io/load_scene.hpp"
#include "scene_io/row_file_internal.hpp"

namespace insonify {
namespace {

/// A float as it is; of a whole number its 32 bits, since -1 stands for 4294967295.
template <typename Value>
Value from_file(double value) {
  if constexpr (std::is_integral_v<Value>)
    return static_cast<Value>(static_cast<std::int64_t>(value));
  else
    return static_cast<Value>(value);
}

}  // namespace

Soundings load_soundings(const std::string& path) {
  require_readable(path);
  const std::optional<RowFile> file = find_ply_rows(path);
  if (!file || file->big_endian)
    fail(ErrorKind::content, path,
         ": is not a binary little-endian PLY of points, so it was not written by save_soundings");
  const RowTable table = read_rows(*file, 0, file->rows);
  const auto each_row = [&](const std::string& name, auto&& take) {
    const auto column = std::find_if(table.columns.begin(), table.columns.end(),
                                     [&](const RowTable::Column& c) { return c.name == name; });
    if (column == table.columns.end())
      fail(ErrorKind::content, path, ": has no column '", name, "', so it was not written by save_soundings");
    for (std::size_t i = 0; i < table.rows; ++i)
      take(i, read_number(table.bytes + i * table.stride + column->offset, column->type));
  };

  Soundings soundings;
  soundings.position.resize(table.rows);
  const char* axes[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis)
    each_row(axes[axis], [&](std::size_t i, double value) { soundings.position[i][axis] = value; });
  each_column(
      [&](const SoundingColumn& column, auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        each_row(std::string("scalar_") + column.name,
                 [&](std::size_t, double value) { values.push_back(from_file<Value>(value)); });
      },
      soundings);
  return soundings;
}

}  // namespace insonify
