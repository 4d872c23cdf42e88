// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads files as their specifications say, and nothing of insonify's: any of the decoders of the tests may throw
// std::runtime_error for a file that breaks its format.
#include <cstdint>
#include <stdexcept>
#include <string>

namespace insonify::decode {

/// A position in a file.
class Cursor {
 public:
  explicit Cursor(const std::string& bytes, std::size_t at = 0) : bytes_(&bytes), at_(at) {}

  std::uint64_t unsigned_big(int size) { return number(size, true); }
  std::uint64_t unsigned_little(int size) { return number(size, false); }
  std::int64_t signed_big(int size) { return sign(number(size, true), size); }
  std::int64_t signed_little(int size) { return sign(number(size, false), size); }
  double float64() {
    const std::uint64_t raw = unsigned_little(8);
    double value;
    static_assert(sizeof value == sizeof raw);
    __builtin_memcpy(&value, &raw, sizeof value);
    return value;
  }
  float float32() {
    const auto raw = static_cast<std::uint32_t>(unsigned_little(4));
    float value;
    __builtin_memcpy(&value, &raw, sizeof value);
    return value;
  }
  std::string text(std::size_t size) {
    need(size);
    at_ += size;
    return bytes_->substr(at_ - size, size);
  }
  std::size_t at() const { return at_; }
  bool done() const { return at_ >= bytes_->size(); }

 private:
  void need(std::size_t size) const {
    if (at_ + size > bytes_->size()) throw std::runtime_error("cut off at byte " + std::to_string(bytes_->size()));
  }
  std::uint64_t number(int size, bool big) {
    need(static_cast<std::size_t>(size));
    std::uint64_t value = 0;
    for (int i = 0; i < size; ++i) {
      const std::uint64_t byte = static_cast<unsigned char>((*bytes_)[at_++]);
      value = big ? value << 8 | byte : value | byte << (8 * i);
    }
    return value;
  }
  static std::int64_t sign(std::uint64_t value, int size) {
    const std::uint64_t top = std::uint64_t{1} << (8 * size - 1);
    return static_cast<std::int64_t>(value ^ top) - static_cast<std::int64_t>(top);
  }

  const std::string* bytes_;
  std::size_t at_;
};

}  // namespace insonify::decode
