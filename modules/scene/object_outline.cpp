// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "scene/object_mesh_internal.hpp"

namespace insonify {
namespace {

/// Returns the sine, or 0 where only rounding makes it differ from 0.
double without_rounding(double sine) { return std::abs(sine) < 1e-14 ? 0 : sine; }

}  // namespace

OutlinePiece straight(double along, double radius, double to_along, double to_radius) {
  const Eigen::Vector2d normal = Eigen::Vector2d(radius - to_radius, to_along - along).normalized();
  return {{along, radius, normal.x(), normal.y()}, {to_along, to_radius, normal.x(), normal.y()}};
}

OutlinePiece elliptic(const Eigen::Vector2d& centre, const Eigen::Vector2d& half, double from, double to,
                      double tolerance) {
  constexpr double widest = pi / 6;
  const double sag = std::min(tolerance / half.maxCoeff(), 1.0);
  const double step = std::min(2 * std::acos(1 - sag), widest);
  const int chords = 2 * static_cast<int>(std::ceil(std::abs(to - from) / step / 2 - 1e-9));  // even: joint at half
  OutlinePiece piece;
  for (int i = 0; i <= chords; ++i) {
    const double angle = from + (to - from) * i / chords;
    const double sine = without_rounding(std::sin(angle)), cosine = without_rounding(std::cos(angle));
    const Eigen::Vector2d normal =
        Eigen::Vector2d(-half.y() * cosine, half.x() * sine).normalized() * (to > from ? 1 : -1);
    piece.push_back({centre.x() - half.x() * cosine, centre.y() + half.y() * sine, normal.x(), normal.y()});
  }
  return piece;
}

int chords_of(double radius, double tolerance) {
  constexpr int least = 12;
  const double sag = std::min(tolerance / radius, 1.0);
  return std::max(least, 4 * static_cast<int>(std::ceil(pi / std::acos(1 - sag) / 4 - 1e-9)));
}

ObjectSizes::ObjectSizes(const ObjectKind& kind, const ObjectSettings& settings)
    : kind_(&kind), options_(options_of(kind)) {
  for (const ObjectOption& option : options_) value_.push_back(option.standard);
  for (const auto& [key, value] : settings) {
    const std::size_t row = row_of(key.c_str());
    const ObjectOption& option = options_[row];
    const bool whole = !option.whole || value == std::floor(value);
    if (!(value >= option.least && value <= option.most) || !whole)
      fail(ErrorKind::argument, "make_object: ", kind.name, ": ", key, " = ", value, *option.unit ? " " : "",
           option.unit, ", must be ", rule_of(option));
    value_[row] = value;
  }
}

std::size_t ObjectSizes::row_of(const char* key) const {
  const auto found =
      std::find_if(options_.begin(), options_.end(), [&](const ObjectOption& o) { return std::string(o.key) == key; });
  if (found != options_.end()) return static_cast<std::size_t>(found - options_.begin());
  std::string known;
  for (const ObjectOption& option : options_) known += (known.empty() ? "" : ", ") + std::string(option.key);
  fail(ErrorKind::argument, "make_object: ", kind_->name, " has no option '", key, "', must be one of: ", known);
}

double ObjectSizes::operator()(const char* key) const { return value_[row_of(key)]; }

void ObjectSizes::require_below(const char* key, double limit, const char* what) const {
  const std::size_t row = row_of(key);
  if (!(value_[row] < limit))
    fail(ErrorKind::argument, "make_object: ", kind_->name, ": ", key, " = ", value_[row],
         *options_[row].unit ? " " : "", options_[row].unit, ", must be below ", what, ", ", limit,
         *options_[row].unit ? " " : "", options_[row].unit);
}

}  // namespace insonify
