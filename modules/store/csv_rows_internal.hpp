#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <string>
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

/// Names of the columns of a table, in the order in which the values of a row are passed on.
using CsvColumns = std::vector<std::string>;

/// Receives the values of one row.
using CsvRowTaker = std::function<void(std::span<const double> row, const FilePlace& place)>;

/// Reads numbers from CSV whose header is one of the `layouts`, its columns in any order. '#' starts a comment line;
/// blank lines, a byte-order mark and Windows line ends are accepted. `take(layout)`, called once the header is known,
/// returns the receiver of the rows, whose values are in the order of layouts[layout].
/// Throws Error(file), or Error(content) with path, line, column and rule; numbers must be finite.
void read_csv(const std::string& path, std::span<const CsvColumns> layouts,
              const std::function<CsvRowTaker(std::size_t layout)>& take);

}  // namespace insonify
