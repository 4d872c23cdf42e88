// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace insonify {

/// Location of an error in a text file.
struct FilePlace {
  const std::string& path;
  std::size_t line = 0;

  template <typename... Parts>
  [[noreturn]] void fail_here(const Parts&... parts) const {
    fail(ErrorKind::content, path, ":", line, ": ", parts...);
  }
};

/// Passes on the lines of a file that are neither blank nor comments ('#'), without blanks at their ends; a byte-order
/// mark and Windows line ends are accepted. Throws Error(file).
void read_lines(const std::string& path,
                const std::function<void(std::string_view line, const FilePlace& place)>& take);

/// Splits a line at its commas into `fields` (reused from line to line: a table may have millions).
void cut_fields(std::string_view line, std::vector<std::string_view>& fields);

/// The number in a field. Throws Error(content) with path, line and column unless it is one and finite.
double read_number(std::string_view text, const std::string& column, const FilePlace& place);

/// Names of the columns of a table, in the order in which the values of a row are passed on.
using CsvColumns = std::vector<std::string>;

/// Receives the values of one row.
using CsvRowTaker = std::function<void(std::span<const double> row, const FilePlace& place)>;

/// Reads numbers from CSV whose header is one of the `layouts`, its columns in any order, line by line as read_lines.
/// `take(layout)`, called once the header is known,
/// returns the receiver of the rows, whose values are in the order of layouts[layout].
/// Throws Error(file), or Error(content) with path, line, column and rule; numbers must be finite.
void read_csv(const std::string& path, std::span<const CsvColumns> layouts,
              const std::function<CsvRowTaker(std::size_t layout)>& take);

}  // namespace insonify
