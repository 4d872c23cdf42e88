// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include <Eigen/Dense>

#include "beamforming/true_delays/wideband_plan_internal.hpp"

namespace insonify {

/// The bend of wavefronts over a block of time, as a short sum of products (E68): beyond the plane wave's delay -y u /
/// c an element at y receives from (r, u) by b / c later, b = sqrt(r^2 - 2 r y u + y^2) - r + y u. At frequency F
/// elements lie at places k = F y period / c between harmonics, and
///
///   exp(2 pi i F (b - b0(y)) / c) = sum over terms q of along_q(u, t) sum over s < band[q] of row_qs(k) power_s(F)
///
/// power_s being WidebandPlan::line_power and b0 the bend of one range and direction, the same for echoes and beams of
/// a block, where it cancels. Found from sampled values by elimination and singular values, to a tolerance of their
/// root mean square; gridding over directions and interpolation between harmonics are undone.
struct BendSeries {
  std::size_t terms = 0;
  std::size_t powers = 0;         ///< of time in [-1, 1] over the block, highest first
  double middle = 0, half = 1;    ///< of the block [s]
  std::size_t stride = 0;         ///< steps of the grid of directions, filled up to a multiple of 8
  std::vector<float> along;       ///< terms x powers x 2 (real, imaginary) x stride
  std::vector<std::size_t> band;  ///< powers of frequency of each term, not growing
  AlignedFloats rows;             ///< for kernels::RowMix
  std::vector<std::size_t> ins;   ///< of each out of it,
  std::size_t most_ins = 0;       ///< out of so many
};

/// How functions of frequency are fitted by powers of it for each row of harmonics: of a plan, for all of its blocks.
struct RowFits {
  struct Row {
    Eigen::VectorXd weight;        ///< of frequencies
    Eigen::MatrixXd across, root;  ///< root x coefficients = across x weighted values
    double counts = 0;             ///< how much the row counts
  };
  Eigen::MatrixXd place;  ///< where rows lie on the array, by row and frequency [m]
  std::vector<Row> row;
  double all = 0;  ///< square of what errors are relative to

  explicit RowFits(const WidebandPlan& plan);
};

/// For echoes of a block from `first` to `last` bin: terms become powers of frequency. Gridding smears echoes over the
/// time of a pulse too, over which the bend changes: that is undone.
BendSeries bend_of_echoes(const WidebandPlan& plan, const RowFits& fits, double first, double last);

/// The conjugate, for beams: powers of frequency become terms.
BendSeries bend_of_beams(const WidebandPlan& plan, const RowFits& fits, double first, double last);

}  // namespace insonify
