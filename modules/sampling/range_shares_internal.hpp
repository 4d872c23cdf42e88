#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace insonify {

/// Shares of a disc's surface for points on it, so that each range has the surface that it should (E128).
///
/// Points of a sequence over a disc are too few and too many by turns along the line of sight, more so the finer the range
/// resolution. Here a point stands for what is nearest to it along that line, the strip of the disc between the middles
/// to its neighbours there. Holds the memory for one disc after the other; not for several threads.
class RangeShares {
 public:
  /// Shares of points at `along`, how far each is from the middle along the line of sight, from -1 to 1 at the disc's
  /// ends: in [0, 1], in their order; their sum is 1 but for rounding. O(points), the same for the same points.
  /// Accuracy 2e-5. For no points, none. Valid until the next call.
  ///
  /// strips: from 0, for all shares alike, to 1, for those of the strips; between them, a mean of both.
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
