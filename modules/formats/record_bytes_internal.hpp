// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "formats/packed_bytes_internal.hpp"

// Private to formats: records that are read from front to back.
namespace insonify {

/// The bytes of a record, which are read one after the other. A read beyond the end throws Error(content).
class RecordBytes {
 public:
  /// `where` names the record in errors, e.g. "x.gsf: record 3 at byte 40".
  RecordBytes(std::string_view bytes, std::string where) : bytes_(bytes), where_(std::move(where)) {}

  const std::string& where() const { return where_; }
  std::size_t size() const { return bytes_.size(); }
  std::size_t left() const { return bytes_.size() - at_; }
  /// Moves to this byte of the record.
  void go_to(std::size_t at) {
    if (at > bytes_.size()) fail(ErrorKind::content, where_, " has ", bytes_.size(), " bytes, refers to byte ", at);
    at_ = at;
  }
  /// Returns the next `count` bytes.
  std::string_view take(std::size_t count) {
    if (count > left())
      fail(ErrorKind::content, where_, " ends at byte ", bytes_.size(), ", within a field of ", count,
           " bytes that begins at byte ", at_);
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }
  /// Return the next number, stored with its highest or its lowest byte first.
  template <typename Number>
  Number big() {
    return big_at<Number>(take(sizeof(Number)), 0);
  }
  template <typename Number>
  Number little() {
    return little_at<Number>(take(sizeof(Number)), 0);
  }
  /// Returns the next `count` bytes up to the first zero.
  std::string text(std::size_t count) { return field_at(take(count), 0, count); }

 private:
  std::string_view bytes_;
  std::string where_;
  std::size_t at_ = 0;
};

}  // namespace insonify
