// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.hpp"
#include "sampling/range_shares_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t few = 16;  // points that need no buckets

/// The part of a unit disc that lies before a line across it, by its distance from the middle: linear between nodes.
class DiscBefore {
 public:
  DiscBefore() {
    for (std::size_t k = 0; k < nodes; ++k) {
      const double x = static_cast<double>(k) / half_nodes - 1;
      before_[k] = 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / pi;
    }
    before_[nodes] = 1;
  }
  double operator()(double line) const {
    const double position = std::clamp((line + 1) * half_nodes, 0.0, 2.0 * half_nodes);
    const auto k = static_cast<std::size_t>(position);
    return before_[k] + (position - static_cast<double>(k)) * (before_[k + 1] - before_[k]);
  }

 private:
  static constexpr std::size_t half_nodes = 512, nodes = 2 * half_nodes + 1;
  std::array<double, nodes + 1> before_{};
};

}  // namespace

// Into as many buckets as there are points, which are nearly even in number.
void RangeShares::fill_buckets(std::span<const float> along) {
  const std::size_t n = along.size();
  const auto bucket = [half = 0.5F * static_cast<float>(n), last = n - 1](float position) {
    return std::min(static_cast<std::size_t>(std::max(0.0F, (position + 1) * half)), last);
  };
  next_.assign(n + 1, 0);
  for (const float position : along) ++next_[bucket(position) + 1];
  for (std::size_t b = 1; b <= n; ++b) next_[b] += next_[b - 1];
  for (std::size_t i = 0; i < n; ++i) sorted_[next_[bucket(along[i])]++] = {along[i], static_cast<std::uint32_t>(i)};
}

void RangeShares::sort(std::span<const float> along) {
  const std::size_t n = along.size();
  sorted_.resize(n);
  if (n > few)
    fill_buckets(along);
  else
    for (std::size_t i = 0; i < n; ++i) sorted_[i] = {along[i], static_cast<std::uint32_t>(i)};
  // From neighbour to neighbour.
  for (std::size_t i = 1; i < n; ++i) {
    const Point moved = sorted_[i];
    std::size_t to = i;
    for (; to > 0 && sorted_[to - 1].along > moved.along; --to) sorted_[to] = sorted_[to - 1];
    sorted_[to] = moved;
  }
}

std::span<const float> RangeShares::operator()(std::span<const float> along, double strips) {
  static const DiscBefore disc_before;
  const std::size_t n = along.size();
  shares_.resize(n);
  if (n == 0) return shares_;
  sort(along);
  const double alike = (1 - strips) / static_cast<double>(n);
  double before = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double upto = i + 1 < n ? disc_before(0.5 * (double{sorted_[i].along} + double{sorted_[i + 1].along})) : 1;
    shares_[sorted_[i].index] = static_cast<float>(alike + strips * (upto - before));  // (E128)
    before = upto;
  }
  return shares_;
}

}  // namespace insonify
