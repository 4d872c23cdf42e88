// SPDX-License-Identifier: BSD-3-Clause
#include "core/error.hpp"
#include "scene_io/read_apart_internal.hpp"

namespace insonify {

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
  stream(raw.format, raw.fields, raw.width, raw.height, raw.triangle, raw.polygon, raw.triangles_in_file,
         raw.bad_triangles, raw.float_coordinates, raw.material_names, raw.notes, raw.named_depth, raw.meaning);
}

SentRows rows_of_doubles(const std::vector<std::string>& names, std::size_t rows) {
  SentRows sent{{}, rows, sizeof(double) * names.size()};
  for (const std::string& name : names)
    sent.columns.push_back({name, NumberType::float64, sizeof(double) * sent.columns.size()});
  return sent;
}

void read_rows_apart(RawCloud& raw, std::size_t bytes, const ReadOptions& options,
                     const std::function<SentRows(ArraySender& to, RawCloud& raw)>& read) {
  ArrayReceiver sent = read_in_child(raw.path, limits_of_file(bytes), [&](ArraySender& to) {
    const SentRows rows = read(to, raw);
    to(rows.columns, rows.rows, rows.stride, raw);
  });
  RowTable table;
  std::size_t held = 0;
  table.bytes = sent.take_array<char>(held);
  sent(table.columns, table.rows, table.stride, raw);
  table.owner = sent.owner();
  if (table.stride > 0 && table.rows > held / table.stride)
    fail(ErrorKind::content, raw.path, ": reading it handed over less than it announced; copy or export it again");
  fill_cloud(raw, table, options);
}

}  // namespace insonify
