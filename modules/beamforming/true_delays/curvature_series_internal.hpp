// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include <Eigen/Dense>

#include "beamforming/true_delays/true_delay_plan_internal.hpp"

namespace insonify {

/// The wavefront curvature over a block of time, as a short sum of products (E68). An element at y receives a wave from
/// (r, u) later than the plane wave's delay -y u / c by b / c, with b = sqrt(r^2 - 2 r y u + y^2) - r + y u. At
/// frequency F the element is at k = F y period / c on the axis of harmonics, and
///
///   exp(2 pi i F (b - b0(y)) / c) = sum over terms q of along_q(u, t) sum over s < band[q] of row_qs(k) power_s(F)
///
/// power_s is TrueDelayPlan::line_power. b0 is the curvature at one range and direction; echoes and beams of a block
/// use the same b0, so it cancels. The sum is found from sampled values by elimination and singular values, to a
/// tolerance relative to their root mean square. The factors also undo the gridding over directions and the
/// interpolation between harmonics.
struct CurvatureSeries {
  std::size_t terms = 0;
  std::size_t powers = 0;         ///< powers of time in [-1, 1] over the block, highest first
  double middle = 0, half = 1;    ///< middle and half length of the block [s]
  std::size_t stride = 0;         ///< steps of the grid of directions, filled up to a multiple of 8
  std::vector<float> along;       ///< terms x powers x 2 (real, imaginary) x stride
  std::vector<std::size_t> band;  ///< number of powers of frequency of each term, in falling order
  Aligned<float> rows;            ///< factors row_qs, ordered for kernels::RowMix
  std::vector<std::size_t> ins;   ///< number of rows in for each row out of the RowMix
  std::size_t most_ins = 0;       ///< rows in for which `rows` has room, per row out
};

/// Least-squares fits of functions of frequency by powers of frequency, for each row of harmonics. All blocks of a plan
/// share them.
struct RowFits {
  struct Row {
    Eigen::VectorXd weight;        ///< weights of frequencies
    Eigen::MatrixXd across, root;  ///< root x coefficients = across x weighted values
    double counts = 0;             ///< weight of the row
  };
  Eigen::MatrixXd position;  ///< where rows lie on the array, by row and frequency [m]
  std::vector<Row> row;
  double all = 0;  ///< errors are relative to the root of this

  explicit RowFits(const TrueDelayPlan& plan);
};

/// Returns the series for a block from bin `first` to `last`. For echoes, terms become powers of frequency; gridding
/// spreads an echo over the length of its pulse, during which the curvature changes, and the series corrects for that.
/// The series of beams is the conjugate, and powers of frequency become terms.
CurvatureSeries curvature_series(const TrueDelayPlan& plan, const RowFits& fits, bool echoes, double first,
                                 double last);

}  // namespace insonify
