// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

namespace insonify {

/// Number types of cloud files.
enum class NumberType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// A number of any of these types, in the same order.
using AnyNumber = std::variant<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t,
                               std::int64_t, std::uint64_t, float, double>;

template <typename Number>
constexpr NumberType type_of_number() {
  return static_cast<NumberType>(AnyNumber(Number{}).index());
}

/// Calls use(zero) with a zero of a type.
template <typename Use>
constexpr auto with_type(NumberType type, const Use& use) {
  constexpr std::array<AnyNumber, 10> zeros = {std::int8_t{},  std::uint8_t{},  std::int16_t{}, std::uint16_t{},
                                               std::int32_t{}, std::uint32_t{}, std::int64_t{}, std::uint64_t{},
                                               float{},        double{}};
  return std::visit(use, zeros[static_cast<std::size_t>(type)]);
}

constexpr std::size_t size_of(NumberType type) {
  return with_type(type, [](auto zero) { return sizeof zero; });
}

constexpr std::array<const char*, 10> number_types = {"int8",   "uint8", "int16",  "uint16",  "int32",
                                                      "uint32", "int64", "uint64", "float32", "float64"};

constexpr const char* name_of(NumberType type) { return number_types[static_cast<std::size_t>(type)]; }

/// Returns the type of this name.
inline std::optional<NumberType> type_named(std::string_view name) {
  for (std::size_t k = 0; k < number_types.size(); ++k)
    if (name == number_types[k]) return static_cast<NumberType>(k);
  return std::nullopt;
}

template <typename T>
T read_as(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

/// Returns the number at `bytes`, in this machine's byte order.
inline double read_number(const char* bytes, NumberType type) {
  return with_type(type, [&](auto zero) { return static_cast<double>(read_as<decltype(zero)>(bytes)); });
}

/// Appends a number that a variable of `type` can hold, in this machine's byte order.
inline void append_number(std::string& bytes, NumberType type, double value) {
  with_type(type, [&](auto zero) {
    zero = static_cast<decltype(zero)>(value);
    bytes.append(reinterpret_cast<const char*>(&zero), sizeof zero);
  });
}

/// Returns true if a variable of `type` can hold the value.
inline bool fits(double value, NumberType type) {
  return with_type(type, [&](auto zero) {
    using Limits = std::numeric_limits<decltype(zero)>;
    const double end = std::ldexp(1.0, Limits::digits);
    return !Limits::is_integer ||
           (value == std::floor(value) && value < end && value >= (Limits::is_signed ? -end : 0));
  });
}

}  // namespace insonify
