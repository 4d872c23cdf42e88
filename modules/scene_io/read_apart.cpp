// SPDX-License-Identifier: BSD-3-Clause
#include "core/error.hpp"
#include "scene_io/read_apart_internal.hpp"

namespace insonify {

SentRows rows_of_doubles(const std::vector<std::string>& names, std::size_t rows) {
  SentRows sent{{}, rows, sizeof(double) * names.size()};
  for (const std::string& name : names)
    sent.columns.push_back({name, NumberType::float64, sizeof(double) * sent.columns.size()});
  return sent;
}

void take_rows(RawCloud& raw, ArrayReceiver sent, const ReadOptions& options) {
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
