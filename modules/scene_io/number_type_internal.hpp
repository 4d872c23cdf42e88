// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
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

/// Calls use(zero) with a zero of a type.
template <typename Use>
auto with_type(NumberType type, const Use& use) {
  switch (type) {
    case NumberType::int8:
      return use(std::int8_t{});
    case NumberType::uint8:
      return use(std::uint8_t{});
    case NumberType::int16:
      return use(std::int16_t{});
    case NumberType::uint16:
      return use(std::uint16_t{});
    case NumberType::int32:
      return use(std::int32_t{});
    case NumberType::uint32:
      return use(std::uint32_t{});
    case NumberType::int64:
      return use(std::int64_t{});
    case NumberType::uint64:
      return use(std::uint64_t{});
    case NumberType::float32:
      return use(float{});
    default:
      return use(double{});
  }
}

/// The number at `bytes`, in this machine's byte order.
inline double read_number(const char* bytes, NumberType type) {
  return with_type(type, [&](auto zero) { return static_cast<double>(read_as<decltype(zero)>(bytes)); });
}

/// Appends a number that a variable of that type can hold, in this machine's byte order.
inline void append_number(std::string& bytes, NumberType type, double value) {
  with_type(type, [&](auto zero) {
    zero = static_cast<decltype(zero)>(value);
    bytes.append(reinterpret_cast<const char*>(&zero), sizeof zero);
  });
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
