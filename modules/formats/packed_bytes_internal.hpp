// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

// Private to formats: numbers as bytes of files.
namespace insonify {

static_assert(std::endian::native == std::endian::little, "insonify: files are packed on little-endian machines");

/// Appends a number, lowest byte first.
template <typename Number>
void put_little(std::string& bytes, Number number) {
  const auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  bytes.append(raw.data(), raw.size());
}

/// Appends a number, highest byte first.
template <typename Number>
void put_big(std::string& bytes, Number number) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

/// Puts a number over the bytes at `offset`, lowest byte first.
template <typename Number>
void put_little_at(std::string& bytes, std::size_t offset, Number number) {
  std::memcpy(bytes.data() + offset, &number, sizeof number);
}

/// Returns the number at `offset`, lowest byte first.
template <typename Number>
Number little_at(std::string_view bytes, std::size_t offset) {
  Number number{};
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

/// Returns the number at `offset`, highest byte first.
template <typename Number>
Number big_at(std::string_view bytes, std::size_t offset) {
  std::array<char, sizeof(Number)> raw;
  std::memcpy(raw.data(), bytes.data() + offset, raw.size());
  std::reverse(raw.begin(), raw.end());
  return std::bit_cast<Number>(raw);
}

/// Returns the text of a field, which ends at its first zero or with the field.
inline std::string field_at(std::string_view bytes, std::size_t offset, std::size_t length) {
  const std::string_view field = bytes.substr(offset, length);
  return std::string(field.substr(0, field.find('\0')));
}

/// Appends text in a field of `length` bytes, zero-filled; longer text is cut.
inline void put_field(std::string& bytes, std::string_view text, std::size_t length) {
  bytes.append(text.substr(0, length));
  bytes.append(length - std::min(length, text.size()), '\0');
}

/// Returns the CRC-32 (IEEE 802.3) of bytes that follow others with the CRC `before`.
inline std::uint32_t crc_32(std::string_view bytes, std::uint32_t before = 0) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      t[i] = i;
      for (int k = 0; k < 8; ++k) t[i] = (t[i] >> 1) ^ (t[i] & 1 ? 0xedb88320u : 0u);
    }
    return t;
  }();
  std::uint32_t crc = ~before;
  for (const char c : bytes) crc = (crc >> 8) ^ table[(crc ^ static_cast<std::uint8_t>(c)) & 0xffu];
  return ~crc;
}

}  // namespace insonify
