// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace insonify {

/// Shares of an echo's energy that means of samples have before an edge of a cell (E227).
///
/// A cell is the mean of samples, of which an edge may divide one: its part before the edge counts there. A single echo has
/// up to 5 % more or less energy in samples than in an integral over range, by where it stands among them.
class CellEdges {
 public:
  /// deviation       standard deviation of the pulse's energy in range [m], a normal law as far as reach_of_pulse
  /// sample_length   distance of samples [m]; 0: the mean is an integral over range
  CellEdges(double deviation, double first_range, double sample_length);

  /// An edge, as the sample that it divides.
  struct Edge {
    double range;  ///< range of the sample [m], or of the edge if there are no samples
    double part;   ///< part of the sample before the edge
  };
  /// Returns the edge at a range [m].
  Edge at(double range) const {
    if (sample_length_ == 0) return {range, 0};
    const double position = (range - first_range_) / sample_length_, sample = std::floor(position);
    return {first_range_ + (sample + 0.5) * sample_length_, position - sample};
  }

  /// Returns the share of an echo's energy before an edge, within 4e-4. Its surface is a box of `half_depth` [m] about
  /// `range` [m].
  double before(const Edge& edge, double range, double half_depth) const {
    const double x = (edge.range - range) * per_deviation_, depth = half_depth * per_deviation_;
    if (depth > 0.25) return (sum_at(x + depth, edge.part) - sum_at(x - depth, edge.part)) / (2 * depth);
    const double aside = depth * gauss_node;  // two nodes are enough for a shallow surface
    return 0.5 * (share_at(x + aside, edge.part) + share_at(x - aside, edge.part));
  }

  /// A part of a surface, a box about the surface's middle [m], with its share of what a cell hears of the surface.
  struct Part {
    double middle, half, share;
  };
  static constexpr std::size_t most_parts = 8;
  /// Sets the parts that the cell between two edges hears of the same surface (E189), evenly over it, so many of each metre;
  /// returns their number, 1 of a surface within the cell.
  std::size_t parts_between(const Edge& near, const Edge& far, double range, double half_depth, double per_metre,
                            std::array<Part, most_parts>& parts) const;

  /// Returns how far from an edge an echo without depth may be to have energy on either side of it [m].
  double reach() const { return reach_; }

 private:
  /// Share before the samples from one on, and part of this one; both also summed up over all distances before.
  struct Entry {
    double before = 0, here = 0;
  };
  static constexpr double gauss_node = 0.57735026918962576;

  double share_at(double x, double part) const;
  double sum_at(double x, double part) const;
  double between(const std::vector<Entry>& table, double x, double part) const;

  double first_range_, sample_length_, per_deviation_, period_, per_period_, reach_;
  double low_, high_, per_step_;  // ends of the tables, in deviations
  std::vector<Entry> share_, sum_;
};

}  // namespace insonify
