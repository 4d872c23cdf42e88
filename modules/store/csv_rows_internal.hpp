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
struct FileLine {
  const std::string& path;
  std::size_t line = 0;

  template <typename... Parts>
  [[noreturn]] void fail_here(const Parts&... parts) const {
    fail(ErrorKind::content, path, ":", line, ": ", parts...);
  }
};

/// Passes on the lines of a file that are neither blank nor comments ('#'), without blanks at their ends. Accepts a
/// byte-order mark and Windows line ends. Throws Error(file).
void read_lines(const std::string& path, const std::function<void(std::string_view line, const FileLine& at)>& take);

/// Splits a line at its commas into `fields`, which is reused because a table may have millions of lines.
void cut_fields(std::string_view line, std::vector<std::string_view>& fields);

/// Returns the number in a field. Throws Error(content) with path, line and column unless it is a finite number.
double read_number(std::string_view text, const std::string& column, const FileLine& at);

/// The names of the columns of a table, in the order of the values that a CsvRowTaker receives.
using CsvColumns = std::vector<std::string>;

/// Receives the values of one row.
using CsvRowTaker = std::function<void(std::span<const double> row, const FileLine& at)>;

/// Reads a table of finite numbers whose header is one of the `layouts`, with its columns in any order, line by line as
/// read_lines. Calls `take(layout)` once the header is known; it returns the receiver of the rows, whose values have
/// the order of layouts[layout]. Throws Error(file), or Error(content) with path, line, column and rule.
void read_csv(const std::string& path, std::span<const CsvColumns> layouts,
              const std::function<CsvRowTaker(std::size_t layout)>& take);

}  // namespace insonify
