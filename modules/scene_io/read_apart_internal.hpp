// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "files/read_apart.hpp"
#include "scene_io/raw_cloud_internal.hpp"

// Private to scene_io: clouds that a library reads.
namespace insonify {

template <typename Stream, typename Value>
void pass(Stream& stream, Meant<Value>& fact) {
  stream(fact.value, fact.origin, fact.sentence);
}

template <typename Stream>
void pass(Stream& stream, FileMeaning& m) {
  stream(m.unit, m.unit_z, m.z_down, m.y_up, m.band, m.no_data, m.valid, m.classes, m.system, m.no_lengths);
}

template <typename Stream>
void pass(Stream& stream, FileDescription::Field& field) {
  stream(field.name, field.type);
}

template <typename Stream>
void pass(Stream& stream, RowTable::Column& column) {
  stream(column.name, column.type, column.offset, column.scale, column.shift, column.mask);
}

/// Sends or receives the facts that a library may find about a cloud.
template <typename Stream>
void pass(Stream& stream, RawCloud& raw) {
  stream(raw.path, raw.format, raw.fields, raw.width, raw.height, raw.triangle, raw.polygon, raw.triangles_in_file,
         raw.bad_triangles, raw.float_coordinates, raw.material_names, raw.notes, raw.named_depth, raw.meaning);
}

/// The layout of the rows that a reader sends. It has taken their bytes from the sender before, by take_array<char>.
struct SentRows {
  std::vector<RowTable::Column> columns;
  std::size_t rows = 0, stride = 0;
};

/// Returns the layout of `rows` rows of doubles with one column per name.
SentRows rows_of_doubles(const std::vector<std::string>& names, std::size_t rows);

/// Makes the points of `raw` by fill_cloud from the rows that were sent, with what their reader found out about it.
void take_rows(RawCloud& raw, ArrayReceiver sent, const ReadOptions& options);

/// Reads a file and the files that it refers to, `bytes` in all, by read_apart: read(to, raw, arguments...) takes memory
/// for the rows from `to`, fills it, and sets members of its copy of `raw`, which become those of `raw`. Throws as
/// read_apart and fill_cloud.
template <typename Read, typename... Arguments>
void read_rows_apart(RawCloud& raw, std::size_t bytes, const ReadOptions& options, Read,
                     const Arguments&... arguments) {
  static_assert(std::is_empty_v<Read>, "captures do not reach another process");
  const auto read_there = [](ArraySender& to, RawCloud& there, const auto&... values) {
    const SentRows rows = Read{}(to, there, values...);
    to(rows.columns, rows.rows, rows.stride, there);
  };
  take_rows(raw, read_apart(raw.path, limits_of_file(bytes), read_there, raw, arguments...), options);
}

}  // namespace insonify
