// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <cstddef>
#include <vector>

#include <Eigen/Dense>

#include "beamforming/true_delays/true_delay_plan_internal.hpp"

namespace insonify {

/// The part of the wavefront curvature that echoes or beams of a block need.
struct CurvatureSpan {
  bool echoes;
  double first_time, last_time;  ///< [s]
  double widest;                 ///< |u|
  double mean_range, mean_u;     ///< range and direction of b0, which is subtracted
};

/// exp(2 pi i F (b - b0) / c), as rows of harmonics need it, at Chebyshev nodes of direction, range, place on the array
/// and frequency.
struct CurvatureSamples {
  using Complex = std::complex<double>;
  using RowMatrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  std::vector<double> u, r;    ///< nodes
  double middle, half;         ///< middle and half length of the span of time [s]
  std::size_t positions;       ///< nodes on the array, to RowPositions::reach
  RowMatrix value;             ///< u x r by node of frequency and place
  std::vector<double> weight;  ///< weight of each column: shading, spectrum, and nodes

  CurvatureSamples(const TrueDelayPlan& plan, const CurvatureSpan& span);

  /// Shading at y; 0 beyond the array.
  static double shading_at(const TrueDelayPlan& plan, double y);

 private:
  void place_nodes(const TrueDelayPlan& plan, const CurvatureSpan& span);
  void sample(const TrueDelayPlan& plan, const CurvatureSpan& span);
  void undo_rows(const TrueDelayPlan& plan);
  /// Fills the other half of the directions: the curvature at (-u, -y) equals that at (u, y).
  void mirror();
  std::size_t half_of_u() const { return (u.size() + 1) / 2; }
};

/// Positions of the rows of harmonics on the array at a frequency `off` below the carrier.
struct RowPositions {
  double row;    ///< distance between rows [m]
  double reach;  ///< distance of the outermost nodes from the middle: that of the outermost row that elements use [m]

  RowPositions(const TrueDelayPlan& plan, double off);
};

/// Reciprocal of the power series sum of moment[j] / (j! moment[0]) z^j.
std::vector<std::complex<double>> inverse_series(const TrueDelayPlan& plan, double frequency);

}  // namespace insonify
