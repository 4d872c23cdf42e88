// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/grid.hpp"
#include "core/pose.hpp"

namespace insonify::python {

/// Writes values one after the other as bytes, or reads them back in the same order, on one machine. Structures are
/// written by members(archive, structure), found by their type.
class Archive {
 public:
  /// Begins to write.
  Archive() = default;
  /// Begins to read what was written.
  explicit Archive(std::string_view bytes) : reads_(true), left_(bytes) {}
  /// Returns what was written.
  const std::string& bytes() const { return bytes_; }
  /// Returns true while nothing is left to read.
  bool ended() const { return left_.empty(); }

  template <typename... Values>
  void operator()(Values&... values) {
    (item(values), ...);
  }

 private:
  void raw(void* data, std::size_t size) {
    if (size == 0) return;
    if (!reads_) {
      bytes_.append(static_cast<const char*>(data), size);
      return;
    }
    if (left_.size() < size) fail(ErrorKind::content, "unpickling: the bytes end early");
    std::memcpy(data, left_.data(), size);
    left_.remove_prefix(size);
  }
  template <typename List>
  void resize(List& list, std::size_t least_size) {
    std::size_t size = list.size();
    raw(&size, sizeof size);
    if (reads_ && size > left_.size() / least_size) fail(ErrorKind::content, "unpickling: the bytes end early");
    if (reads_) list.resize(size);
  }
  void item(std::string& text) { resize(text, 1), raw(text.data(), text.size()); }
  void item(Pose& pose) { raw(pose.matrix().data(), sizeof(double) * 16); }
  template <typename T>
  void item(Grid<T>& grid) {
    Eigen::Index rows = grid.rows(), columns = grid.cols();
    raw(&rows, sizeof rows), raw(&columns, sizeof columns);
    if (reads_) {
      const bool fits =
          rows >= 0 && columns >= 0 &&
          static_cast<double>(rows) * static_cast<double>(columns) * sizeof(T) <= static_cast<double>(left_.size());
      if (!fits) fail(ErrorKind::content, "unpickling: the bytes end early");
      grid.resize(rows, columns);
    }
    raw(grid.data(), static_cast<std::size_t>(grid.size()) * sizeof(T));
  }
  template <typename T, int rows, int columns>
  void item(Eigen::Matrix<T, rows, columns>& m) {
    raw(m.data(), sizeof(T) * static_cast<std::size_t>(rows * columns));
  }
  template <typename T>
  void item(std::vector<T>& list) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      resize(list, sizeof(T)), raw(list.data(), list.size() * sizeof(T));
    } else {
      resize(list, 1);
      for (T& value : list) item(value);
    }
  }
  template <typename T>
  void item(T& value) {
    if constexpr (std::is_trivially_copyable_v<T>)
      raw(&value, sizeof value);
    else
      members(*this, value);
  }

  bool reads_ = false;
  std::string bytes_;
  std::string_view left_;
};

}  // namespace insonify::python
