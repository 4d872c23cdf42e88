#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace insonify {

/// Number types of cloud files.
enum class NumberType : std::uint8_t {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64
};

constexpr std::size_t size_of(NumberType type) {
  constexpr std::array<std::size_t, 10> sizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

constexpr const char* name_of(NumberType type) {
  constexpr std::array<const char*, 10> names = {"int8",   "uint8", "int16",  "uint16",  "int32",
                                                 "uint32", "int64", "uint64", "float32", "float64"};
  return names[static_cast<std::size_t>(type)];
}

/// The number at `bytes`, byte order turned if `swap`.
template <typename T>
T read_as(const char* bytes, bool swap) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, sizeof(T));
  if (swap) std::reverse(raw.begin(), raw.end());
  T value;
  std::memcpy(&value, raw.data(), sizeof(T));
  return value;
}

inline double read_number(const char* bytes, NumberType type, bool swap) {
  switch (type) {
    case NumberType::int8:
      return read_as<std::int8_t>(bytes, swap);
    case NumberType::uint8:
      return read_as<std::uint8_t>(bytes, swap);
    case NumberType::int16:
      return read_as<std::int16_t>(bytes, swap);
    case NumberType::uint16:
      return read_as<std::uint16_t>(bytes, swap);
    case NumberType::int32:
      return read_as<std::int32_t>(bytes, swap);
    case NumberType::uint32:
      return read_as<std::uint32_t>(bytes, swap);
    case NumberType::int64:
      return static_cast<double>(read_as<std::int64_t>(bytes, swap));
    case NumberType::uint64:
      return static_cast<double>(read_as<std::uint64_t>(bytes, swap));
    case NumberType::float32:
      return read_as<float>(bytes, swap);
    case NumberType::float64:
      return read_as<double>(bytes, swap);
  }
  return 0;
}

}  // namespace insonify
