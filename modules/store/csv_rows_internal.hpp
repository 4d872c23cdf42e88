#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace insonify {

/// Where an error message about a text file points.
struct FilePlace {
  const std::string& path;
  std::size_t line = 0;

  template <typename... Parts>
  [[noreturn]] void fail_here(const Parts&... parts) const {
    fail(ErrorKind::content, path, ":", line, ": ", parts...);
  }
};

/// Names of the columns that make up a table, in the order in which its rows are handed on.
using CsvColumns = std::vector<std::string>;

/// Takes the values of one row.
using CsvRowTaker = std::function<void(std::span<const double> row, const FilePlace& place)>;

/// Reads numbers from CSV with a header: one of the `layouts`, its columns in any order. '#' starts a comment line;
/// blank lines, a byte-order mark and Windows line ends are let pass. `take(layout)`, called once the header is known,
/// gives what takes the rows, their values in the order of layouts[layout].
/// Throws Error(file), or Error(content) with path, line, column and rule; numbers must be finite.
void read_csv(const std::string& path, std::span<const CsvColumns> layouts,
              const std::function<CsvRowTaker(std::size_t layout)>& take);

}  // namespace insonify
