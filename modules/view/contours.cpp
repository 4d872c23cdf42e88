// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <utility>

#include "view/contours_internal.hpp"

namespace insonify {
namespace {

/// A side between two neighbouring cells: the first of them, and 0 for one along x, 1 for one along y.
using SideKey = std::array<Eigen::Index, 3>;

/// The pieces of contours, from side to side.
struct SquarePieces {
  const Grid<float>& values;
  double level;
  std::multimap<SideKey, SideKey> next;

  bool above(Eigen::Index x, Eigen::Index y) const { return static_cast<double>(values(x, y)) >= level; }
  Eigen::Vector2d place(const SideKey& side) const {
    const auto [x, y, along_y] = side;
    const auto from = static_cast<double>(values(x, y));
    const auto to = static_cast<double>(values(x + (along_y == 0), y + (along_y != 0)));
    const double share = (level - from) / (to - from);
    return {static_cast<double>(x) + (along_y == 0 ? share : 0), static_cast<double>(y) + (along_y == 0 ? 0 : share)};
  }
  void join(const SideKey& a, const SideKey& b) { next.emplace(a, b), next.emplace(b, a); }
  /// Adds the pieces within the square whose first corner is a cell.
  void add(Eigen::Index x, Eigen::Index y) {
    const std::array<SideKey, 4> sides = {{{x, y, 0}, {x + 1, y, 1}, {x, y + 1, 0}, {x, y, 1}}};
    const std::array<bool, 4> corners = {above(x, y), above(x + 1, y), above(x + 1, y + 1), above(x, y + 1)};
    std::vector<SideKey> crossed;
    for (std::size_t k = 0; k < 4; ++k)
      if (corners[k] != corners[(k + 1) % 4]) crossed.push_back(sides[k]);
    if (crossed.size() == 2) join(crossed[0], crossed[1]);
    if (crossed.size() < 4) return;
    // A saddle: the middle says which corners belong together.
    const float middle = (values(x, y) + values(x + 1, y) + values(x, y + 1) + values(x + 1, y + 1)) / 4;
    const bool with_first = (static_cast<double>(middle) >= level) == corners[0];
    join(sides[0], sides[with_first ? 1 : 3]);
    join(sides[2], sides[with_first ? 3 : 1]);
  }
  /// Takes the piece from a side on, and moves to its other end; returns false if there is none.
  bool take(SideKey& at) {
    const SideKey from = at;
    const auto found = next.find(from);
    if (found == next.end()) return false;
    at = found->second;
    next.erase(found);
    const auto [begin, end] = next.equal_range(at);
    next.erase(std::find_if(begin, end, [&](const auto& piece) { return piece.second == from; }));
    return true;
  }
};

}  // namespace

std::vector<Contour> contours_at(const Grid<float>& values, double level) {
  SquarePieces pieces{values, level, {}};
  for (Eigen::Index x = 0; x + 1 < values.rows(); ++x)
    for (Eigen::Index y = 0; y + 1 < values.cols(); ++y)
      if (values.block(x, y, 2, 2).isFinite().all()) pieces.add(x, y);
  std::vector<Contour> lines;
  while (!pieces.next.empty()) {
    const SideKey first = pieces.next.begin()->first;
    std::deque<Eigen::Vector2d> line = {pieces.place(first)};
    SideKey at = first;
    while (pieces.take(at)) line.push_back(pieces.place(at));
    at = first;
    while (pieces.take(at)) line.push_front(pieces.place(at));
    lines.emplace_back(line.begin(), line.end());
  }
  return lines;
}

Grid<float> relief_of(const Grid<float>& values, double exaggeration) {
  const auto difference = [&](Eigen::Index x, Eigen::Index y, Eigen::Index dx, Eigen::Index dy) {
    const auto at = [&](Eigen::Index sign) {
      const Eigen::Index i = x + sign * dx, k = y + sign * dy;
      const bool inside = i >= 0 && k >= 0 && i < values.rows() && k < values.cols();
      return inside && std::isfinite(values(i, k)) ? std::pair(values(i, k), 1) : std::pair(values(x, y), 0);
    };
    const auto [high, one] = at(1);
    const auto [low, other] = at(-1);
    return one + other == 0 ? 0.0 : exaggeration * static_cast<double>(high - low) / (one + other);
  };
  const Eigen::Vector3d light(-0.5, 0.5, std::sqrt(0.5));
  Grid<float> bright = Grid<float>::Ones(values.rows(), values.cols());
  for (Eigen::Index x = 0; x < values.rows(); ++x)
    for (Eigen::Index y = 0; y < values.cols(); ++y) {
      if (!std::isfinite(values(x, y))) continue;
      const Eigen::Vector3d normal(-difference(x, y, 1, 0), -difference(x, y, 0, 1), 1);
      bright(x, y) = static_cast<float>(std::max(0.0, normal.normalized().dot(light)) / light.z());  // (E218)
    }
  return bright;
}

}  // namespace insonify
