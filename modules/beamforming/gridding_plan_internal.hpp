#pragma once
#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "beamforming/gridding_kernel_internal.hpp"
#include "beamforming/gridding_loops_internal.hpp"
#include "beamforming/ping_synthesizer.hpp"
#include "beamforming/time_axis_internal.hpp"

namespace insonify {

constexpr std::size_t grid_pad = 16;  ///< columns before the grid's first and after its last

/// What gridding in one precision has in common for all pings of a head. Directions are counted as phase from one element
/// to the next, in cycles; a grid of `grid` steps covers one cycle. Elements stand at whole places for odd numbers of
/// them and at half ones for even numbers: then everything changes sign from one cycle to the next.
template <typename Real>
struct GriddingPlan {
  using Complex = std::complex<Real>;

  SonarHead head;
  Medium medium;
  TimeAxis axis;
  double cut;  ///< pulses are cut where they fall below this
  EchoShapes shapes;
  bool one_shape;  ///< absorption leaves every pulse its shape: samples are polynomials of its offset from the bins
  GriddingKernel kernel;
  std::size_t grid, stride, tile_bins, margin = 0, tile_rows = 0;
  std::size_t grid_row;  ///< numbers from one grid step to the next: no power of 2, which would crowd a few cache sets
  double cycles_per_u, half_place;

  PolynomialPieces<Real> columns, rows, rows_im;  ///< rows_im: of a sweep
  bool sweep = false, sweep_ends = false;         ///< one_shape of a sweep; its ends are among the rows
  double half = 0;                                ///< of what is planned of a pulse [s]
  double pulse_energy = 0;                        ///< of the planned pulse with unit peak [bins]

  std::vector<Complex> half_turn;       ///< exp(i half_place 2 pi j / grid)
  std::vector<Complex> element;         ///< shading, deconvolution: by grid frequency; 0 where no element is
  std::vector<Real> beam_weight;        ///< beams x width
  std::vector<std::uint32_t> beam_row;  ///< beams x width
  SynthesisChoice choice;

  /// kernel_tolerance: error of the kernel relative to what is gridded.
  GriddingPlan(const SonarHead& head, const Medium& medium, double tolerance, double kernel_tolerance);

  std::size_t tiles() const { return (axis.bins + tile_bins - 1) / tile_bins; }

  /// Where a direction lies on the grid: step, and the sign that whole cycles bring along.
  struct Place {
    double step, sign;
  };
  Place place_of(double u) const;

 private:
  void plan_time(double tolerance, double kernel_tolerance);
  void plan_elements();
  void plan_beams();
};

}  // namespace insonify
