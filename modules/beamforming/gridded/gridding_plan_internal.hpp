// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "beamforming/gridded/column_plan_internal.hpp"
#include "beamforming/gridded/gridded_engine.hpp"
#include "beamforming/gridded/gridding_loops_internal.hpp"
#include "beamforming/numerics/gridding_kernel_internal.hpp"
#include "beamforming/pulses/time_axis_internal.hpp"

namespace insonify {

/// Constants of the gridded synthesis in one precision, shared by all pings of a head (E13). A direction is represented
/// by the phase between neighbouring elements [cycles]; `grid` steps cover one cycle. Element positions are integers
/// for odd numbers of elements and half-integers for even ones, in which case the grid changes sign from one cycle to
/// the next. A planar array has a grid over v too, whose lines are such grids; a line array is one line.
template <typename Real>
struct GriddingPlan {
  using Complex = std::complex<Real>;

  SonarHead head;
  Medium medium;
  TimeAxis axis;
  double cut;  ///< pulses are cut where they fall below this fraction of their peak
  EchoShapes shapes;
  GriddingKernel kernel;
  std::size_t grid, stride, tile_bins, margin = 0, tile_rows = 0;
  std::size_t grid_row;  ///< row stride of the grid; not a power of 2, to avoid cache conflicts
  double cycles_per_u, element_offset;

  PolynomialPieces<Real> columns;             ///< polynomials of the kernel over u
  PolynomialPieces<Real> sweep_re, sweep_im;  ///< samples of a sweep whose shape absorption keeps; else empty
  bool sweep_ends = false;                    ///< they include the ends of the sweep
  double half = 0;                            ///< half length of a pulse as sent; of a sweep, whole bins [s]
  double longest_half = 0;                    ///< half length of the longest Gaussian pulse of any shape [s]
  std::size_t longest_rows = 0;               ///< rows of such a pulse; 0: sweeps
  double pulse_energy = 0;                    ///< energy of the pulse as sent, with unit peak [bins]

  std::vector<Complex> offset_phase;       ///< exp(i element_offset 2 pi j / grid)
  std::vector<Complex> element;            ///< shading / deconvolution factor, by grid frequency; 0 without element
  std::vector<Real> beam_weight;           ///< beams x width
  std::vector<std::uint32_t> beam_row;     ///< beams x width
  std::vector<FanRow> fan;                 ///< rows of beams
  std::optional<ColumnPlan<Real>> column;  ///< plan over v; a planar array alone has one
  SynthesisChoice choice;

  GriddingPlan(const SonarHead& head, const Medium& medium, double tolerance, KernelTolerance kernels);

  /// Position of a direction on the grid: step, and sign due to whole cycles.
  struct Position {
    double step, sign;
  };
  Position position_of(double u) const;
  /// Half lengths of the pulses of a scene and a head at rest, or of moving ones.
  PulseReach reach(bool moving) const;

 private:
  void plan_time(double tolerance);
  void plan_elements();
  void plan_beams();
};

}  // namespace insonify
