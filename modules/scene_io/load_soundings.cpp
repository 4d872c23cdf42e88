// SPDX-License-Identifier: BSD-3-Clause
#include "core/error.hpp"
#include "returns/sounding_columns.hpp"
#include "scene_io/load_scene.hpp"
#include "scene_io/row_file_internal.hpp"

namespace insonify {
namespace {

/// Returns a float unchanged; for a whole number its 32 bits, since -1 stands for 4294967295.
template <typename Value>
Value from_file(double value) {
  if constexpr (std::is_integral_v<Value>)
    return static_cast<Value>(static_cast<std::int64_t>(value));
  else
    return static_cast<Value>(value);
}

/// The columns of a PLY of points.
class ReturnsTable {
 public:
  explicit ReturnsTable(const std::string& path) : path_(path) {
    const RowFile file =
        rows_of_ply(path, "is not a binary little-endian PLY of points, so it was not written by save_soundings");
    table_ = read_rows(file, 0, file.rows);
  }
  std::size_t rows() const { return table_.rows; }
  bool has(const std::string& name) const { return column_named(table_.columns, name); }

  template <typename Value>
  void append(const std::string& name, std::vector<Value>& values) const {
    const RowTable::Column* const column = column_named(table_.columns, name);
    if (!column)
      fail(ErrorKind::content, path_, ": has no column '", name, "', so it was not written by save_soundings");
    for (std::size_t i = 0; i < table_.rows; ++i)
      values.push_back(from_file<Value>(column->value(table_.bytes + i * table_.stride)));
  }

 private:
  std::string path_;
  RowTable table_;
};

void append_soundings(const ReturnsTable& table, Soundings& soundings) {
  std::vector<double> positions[3];
  const char* axes[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) table.append(axes[axis], positions[axis]);
  for (std::size_t i = 0; i < table.rows(); ++i)
    soundings.position.emplace_back(positions[0][i], positions[1][i], positions[2][i]);
  const auto append = [&](const SoundingColumn& column, auto& values) {
    table.append(std::string("scalar_") + column.name, values);
  };
  each_common_column(append, soundings);
  if (table.has(std::string("scalar_") + order_column.name) || !soundings.true_order.empty())
    append(order_column, soundings.true_order);
}

}  // namespace

Soundings load_soundings(const std::string& path) {
  Soundings soundings;
  append_soundings(ReturnsTable(path), soundings);
  return soundings;
}

SurveyReturns load_survey_returns(const std::vector<std::string>& paths) {
  SurveyReturns returns;
  for (const std::string& path : paths) {
    const ReturnsTable table(path);
    append_soundings(table, returns.soundings);
    if (!table.has("scalar_head")) continue;
    table.append("scalar_time", returns.time);
    table.append("scalar_head", returns.head);
  }
  return returns;
}

}  // namespace insonify
