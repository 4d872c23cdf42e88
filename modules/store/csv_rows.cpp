// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "core/text.hpp"
#include "store/csv_rows_internal.hpp"
#include "store/nearest_word.hpp"
#include "store/run_directory.hpp"

namespace insonify {
namespace {

bool holds(const CsvColumns& columns, std::string_view name) {
  return std::find(columns.begin(), columns.end(), name) != columns.end();
}

/// The layout of a file, and for each field the index of its column.
struct Header {
  std::size_t layout = 0;
  std::vector<std::size_t> columns;
};

std::size_t nearest_layout(std::span<const CsvColumns> layouts, const std::vector<std::string_view>& fields) {
  const auto shared = [&](const CsvColumns& layout) {
    return std::count_if(fields.begin(), fields.end(), [&](std::string_view field) { return holds(layout, field); });
  };
  const auto best = std::max_element(layouts.begin(), layouts.end(),
                                     [&](const auto& a, const auto& b) { return shared(a) < shared(b); });
  return static_cast<std::size_t>(best - layouts.begin());
}

Header read_header(std::span<const CsvColumns> layouts, const std::vector<std::string_view>& fields,
                   const FileLine& at) {
  CsvColumns known;
  for (const CsvColumns& layout : layouts) known.insert(known.end(), layout.begin(), layout.end());
  for (auto field = fields.begin(); field != fields.end(); ++field) {
    if (!holds(known, *field)) at.fail_here("unknown column '", *field, "'", did_you_mean(std::string(*field), known));
    if (std::find(fields.begin(), field, *field) != field) at.fail_here("column '", *field, "' occurs twice");
  }
  Header header{nearest_layout(layouts, fields), {}};
  const CsvColumns& layout = layouts[header.layout];
  for (const std::string& column : layout)
    if (std::find(fields.begin(), fields.end(), column) == fields.end()) at.fail_here("missing column '", column, "'");
  for (const std::string_view field : fields) {
    if (!holds(layout, field)) at.fail_here("column '", field, "' cannot be combined with '", layout.back(), "'");
    header.columns.push_back(static_cast<std::size_t>(std::find(layout.begin(), layout.end(), field) - layout.begin()));
  }
  return header;
}

}  // namespace

void cut_fields(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    fields.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
}

void read_lines(const std::string& path, const std::function<void(std::string_view line, const FileLine& at)>& take) {
  const std::string text = read_text_file(path);
  std::string_view rest = text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // skip the byte-order mark of spreadsheets
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = trimmed(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (!line.empty() && line[0] != '#') take(line, {path, number});
  }
}

double read_number(std::string_view text, const std::string& column, const FileLine& at) {
  const auto number = finite_number(text);
  if (!number) at.fail_here(column, " = '", text, "', must be a finite number");
  return *number;
}

void read_csv(const std::string& path, std::span<const CsvColumns> layouts,
              const std::function<CsvRowTaker(std::size_t layout)>& take) {
  Header header;
  CsvRowTaker take_row;
  std::vector<std::string_view> fields;
  std::vector<double> row;
  read_lines(path, [&](std::string_view line, const FileLine& at) {
    cut_fields(line, fields);
    if (!take_row) {
      header = read_header(layouts, fields, at);
      row.resize(header.columns.size());
      take_row = take(header.layout);
      return;
    }
    if (fields.size() != row.size()) at.fail_here("has ", fields.size(), " fields, the header has ", row.size());
    for (std::size_t i = 0; i < fields.size(); ++i)
      row[header.columns[i]] = read_number(fields[i], layouts[header.layout][header.columns[i]], at);
    take_row(row, at);
  });
  if (take_row) return;
  fail(ErrorKind::content, path, ": has no header, must start with ",
       joined(layouts, " or ", [](const CsvColumns& layout) { return joined(layout, ","); }));
}

}  // namespace insonify
