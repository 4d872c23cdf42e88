#pragma once
#include <functional>

/// Documented.
struct First {
  std::function<void(int)> member;
  First() = default;
  int silent() const { return 1; }
  int beside() const { return 2; }  ///< Documented.
};

using Number = double;
enum class Silent { a, b };
template <typename T>
T silent(T (*f)(T));
/// Documented.
template <typename T>
T loud(T x) {
  return x;
}
