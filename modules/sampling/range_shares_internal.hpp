// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace insonify {

/// Divides a disc's surface among points on it, so that each range gets the surface that lies there (E128).
///
/// Along the line of sight, points of a sequence over a disc are alternately too dense and too sparse. Each point
/// therefore represents the strip of the disc that is nearest to the point along that line, up to the middles between
/// the point and its neighbours. An object keeps its buffers from disc to disc, and serves one thread.
class RangeShares {
 public:
  /// Returns the fraction of the surface of each point, in their order; the sum is 1 but for rounding. Accuracy 2e-5,
  /// O(points). Valid until the next call.
  ///
  /// along    distance of each point from the middle along the line of sight, from -1 to 1 at the ends of the disc
  /// strips   1: strips; 0: equal fractions; between them, a mean of both
  std::span<const float> operator()(std::span<const float> along, double strips);

 private:
  struct Point {
    float along;
    std::uint32_t index;
  };
  std::vector<Point> sorted_;
  std::vector<std::uint32_t> next_;
  std::vector<float> shares_;
  void sort(std::span<const float> along);
  void fill_buckets(std::span<const float> along);
};

}  // namespace insonify
