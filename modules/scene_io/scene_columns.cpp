// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/scene_columns.hpp"

#include <algorithm>
#include <memory>
#include <unordered_map>

#include "core/error.hpp"
#include "core/text.hpp"
#include "scene_io/column_names_internal.hpp"
#include "scene_io/scene_columns_internal.hpp"

namespace insonify {
namespace {

NumberType type_of(const SceneColumn& column) {
  if (const auto type = type_named(column.type)) return *type;
  fail(ErrorKind::argument, "save_scene: column '", column.name, "' has type '", column.type,
       "', must be one of int8 to float64");
}

/// Returns a type that readers of PLY (and, of 64 bits, of PCD) take and that holds all numbers of the column.
NumberType written_type(const SceneColumn& column, NumberType type, CloudFormat format) {
  if (type == NumberType::int64 || type == NumberType::uint64) return NumberType::float64;
  if (format == CloudFormat::pcd || type == NumberType::uint8 || type >= NumberType::float32) return type;
  if (type != NumberType::uint32) return NumberType::int32;
  for (std::size_t at = 0; at < column.bytes.size(); at += 4)
    if (read_as<std::uint32_t>(column.bytes.data() + at) > 2147483647) return NumberType::float64;
  return NumberType::int32;
}

std::vector<char> converted(const SceneColumn& column, NumberType from, NumberType to) {
  if (from == to) return column.bytes;
  const std::size_t rows = column.bytes.size() / size_of(from);
  std::vector<char> bytes(rows * size_of(to));
  char* out = bytes.data();
  for (std::size_t i = 0; i < rows; ++i) {
    const double number = read_number(column.bytes.data() + i * size_of(from), from);
    if (to == NumberType::float64)
      put(out, number);
    else
      put(out, static_cast<std::int32_t>(number));
  }
  return bytes;
}

}  // namespace

SceneColumn copy_of(const RowTable& table, const RowTable::Column& column, const std::string& name) {
  const bool as_it_is = column.scale == 1 && column.shift == 0 && column.mask == 0xff;
  SceneColumn copy{name, name_of(as_it_is ? column.type : NumberType::float64), {}};
  const std::size_t size = as_it_is ? size_of(column.type) : sizeof(double);
  copy.bytes.resize(table.rows * size);
  char* out = copy.bytes.data();
  constexpr std::size_t block = 1 << 16;
  for (std::size_t first = 0; first < table.rows; first += block) {
    const std::size_t rows = std::min(block, table.rows - first);
    table.with_rows(first, rows, [&](const char* row) {
      for (std::size_t i = 0; i < rows; ++i, row += table.stride, out += size) {
        const double value = as_it_is ? 0 : column.value(row);
        std::memcpy(out, as_it_is ? row + column.offset : reinterpret_cast<const char*>(&value), size);
      }
    });
  }
  return copy;
}

void take_columns(RawCloud& raw, const LoadOptions& options, SceneColumns& columns) {
  columns.others = std::move(raw.columns);
  const auto has = [&](const std::string& name) {
    return std::any_of(columns.others.begin(), columns.others.end(),
                       [&](const SceneColumn& column) { return plain_name(column.name) == plain_name(name); });
  };
  if (!raw.label_field.empty() && !options.material && options.material_field.intervals.empty()) {
    columns.material = raw.label_field;
    columns.others.pop_back();  // column of the labels
  } else if (has("material")) {
    columns.material = "material_index";
  }
}

void keep_rows(SceneColumn& column, const std::vector<std::uint32_t>& rows) {
  const std::size_t size = size_of(type_of(column));
  std::vector<char> bytes(rows.size() * size);
  for (std::size_t i = 0; i < rows.size(); ++i)
    std::memcpy(bytes.data() + i * size, column.bytes.data() + rows[i] * size, size);
  column.bytes = std::move(bytes);
}

SceneColumns columns_of(const SceneColumns& columns, std::span<const std::uint32_t> ids,
                        std::span<const std::uint32_t> kept) {
  std::unordered_map<std::uint32_t, std::size_t> row_of;
  for (std::size_t i = 0; i < ids.size(); ++i) row_of[ids[i]] = i;
  SceneColumns part{columns.material, {}, columns.system};
  for (const SceneColumn& column : columns.others) {
    SceneColumn& of_kept = part.others.emplace_back(SceneColumn{column.name, column.type, {}});
    const auto size = static_cast<std::ptrdiff_t>(size_of(type_of(column)));
    for (const std::uint32_t id : kept) {
      const auto from = column.bytes.begin() + static_cast<std::ptrdiff_t>(row_of.at(id)) * size;
      of_kept.bytes.insert(of_kept.bytes.end(), from, from + size);
    }
  }
  return part;
}

void add_columns(PackedRows& rows, const SceneColumns& columns, CloudFormat format) {
  // Give the columns legal names that differ from those in use; comments name the originals.
  std::vector<std::string> names = {columns.material}, taken = {"area", "id", "noise"};
  for (const SceneColumn& column : columns.others) names.push_back(column.name);
  for (const PackedRows::Column& column : rows.columns)
    if (!column.name.empty()) taken.push_back(column.name);
  const std::vector<std::string> legal = legal_names(names, taken);
  if (columns.material != "material" || !columns.others.empty())
    rows.comments.push_back("insonify material_field " + legal[0]);
  for (std::size_t k = 0; k < names.size(); ++k)
    if (legal[k] != names[k] && legal[k] != names[k] + "_in_file")
      rows.comments.push_back("insonify column " + legal[k] + " " + json_text(names[k]));
  for (PackedRows::Column& column : rows.columns)
    if (column.name.empty()) column.name = legal[0];

  for (std::size_t k = 0; k < columns.others.size(); ++k) {
    const SceneColumn& column = columns.others[k];
    const NumberType type = type_of(column), to = written_type(column, type, format);
    if (column.bytes.size() != rows.rows * size_of(type))
      fail(ErrorKind::argument, "save_scene: column '", column.name, "' has ", column.bytes.size(),
           " bytes, must have a number of ", column.type, " for each of the ", rows.rows, " surfels");
    const auto bytes = std::make_shared<const std::vector<char>>(converted(column, type, to));
    rows.columns.push_back(
        {legal[k + 1], to,
         [bytes, size = size_of(to)](std::size_t first, std::size_t count, char* out, std::size_t stride) {
           for (std::size_t i = first; i < first + count; ++i, out += stride)
             std::memcpy(out, bytes->data() + i * size, size);
         }});
  }
}

}  // namespace insonify
