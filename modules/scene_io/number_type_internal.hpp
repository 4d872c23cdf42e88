// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace insonify {

/// Number types of cloud files.
enum class NumberType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

constexpr std::size_t size_of(NumberType type) {
  constexpr std::array<std::size_t, 10> sizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

constexpr const char* name_of(NumberType type) {
  constexpr std::array<const char*, 10> names = {"int8",   "uint8", "int16",  "uint16",  "int32",
                                                 "uint32", "int64", "uint64", "float32", "float64"};
  return names[static_cast<std::size_t>(type)];
}

/// The size of a type by its name, 0 of another name.
inline std::size_t size_named(std::string_view name) {
  for (std::size_t k = 0; k <= static_cast<std::size_t>(NumberType::float64); ++k)
    if (const auto type = static_cast<NumberType>(k); name == name_of(type)) return size_of(type);
  return 0;
}

template <typename T>
T read_as(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

/// The number at `bytes`, in this machine's byte order.
inline double read_number(const char* bytes, NumberType type) {
  switch (type) {
    case NumberType::int8:
      return read_as<std::int8_t>(bytes);
    case NumberType::uint8:
      return read_as<std::uint8_t>(bytes);
    case NumberType::int16:
      return read_as<std::int16_t>(bytes);
    case NumberType::uint16:
      return read_as<std::uint16_t>(bytes);
    case NumberType::int32:
      return read_as<std::int32_t>(bytes);
    case NumberType::uint32:
      return read_as<std::uint32_t>(bytes);
    case NumberType::int64:
      return static_cast<double>(read_as<std::int64_t>(bytes));
    case NumberType::uint64:
      return static_cast<double>(read_as<std::uint64_t>(bytes));
    case NumberType::float32:
      return read_as<float>(bytes);
    case NumberType::float64:
      return read_as<double>(bytes);
  }
  return 0;
}

/// True if a variable of that type can hold the value.
inline bool fits(double value, NumberType type) {
  if (type >= NumberType::float32) return true;
  const bool has_sign =
      type == NumberType::int8 || type == NumberType::int16 || type == NumberType::int32 || type == NumberType::int64;
  const double end = std::ldexp(1.0, static_cast<int>(8 * size_of(type)) - (has_sign ? 1 : 0));
  return value == std::floor(value) && value < end && value >= (has_sign ? -end : 0);
}

}  // namespace insonify
