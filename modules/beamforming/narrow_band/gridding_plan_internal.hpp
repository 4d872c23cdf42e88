#pragma once
#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "beamforming/narrow_band/gridding_loops_internal.hpp"
#include "beamforming/numerics/gridding_kernel_internal.hpp"
#include "beamforming/ping_synthesizer.hpp"
#include "beamforming/pulses/time_axis_internal.hpp"

namespace insonify {

constexpr std::size_t grid_pad = 16;  ///< padding columns on either side of the grid

/// Returns the smallest even number >= `least` without a prime factor above 5, a fast length for FFTW.
std::size_t fft_length(std::size_t least);

/// Constants of the gridded synthesis in one precision, shared by all pings of a head. A direction is represented by
/// the phase between neighbouring elements [cycles]; `grid` steps cover one cycle. Element positions are integers for
/// odd numbers of elements and half-integers for even ones, in which case the grid changes sign from one cycle to the
/// next.
template <typename Real>
struct GriddingPlan {
  using Complex = std::complex<Real>;

  SonarHead head;
  Medium medium;
  TimeAxis axis;
  double cut;  ///< pulses are cut where they fall below this fraction of their peak
  EchoShapes shapes;
  bool common_shape;  ///< absorption keeps the pulse shape: samples are polynomials of the offset from the bins
  GriddingKernel kernel;
  std::size_t grid, stride, tile_bins, margin = 0, tile_rows = 0;
  std::size_t grid_row;  ///< row stride of the grid; not a power of 2, to avoid cache conflicts
  double cycles_per_u, element_offset;

  PolynomialPieces<Real> columns, rows, rows_im;  ///< rows_im: of a sweep
  bool sweep = false, sweep_ends = false;         ///< linear FM pulses of common shape; the rows include their ends
  double half = 0;                                ///< half length of the planned part of a pulse [s]
  double longest_half = 0;                        ///< of Gaussian pulses of any shape [s]
  std::size_t longest_rows = 0;                   ///< rows of such a pulse
  double pulse_energy = 0;                        ///< energy of the planned pulse with unit peak [bins]

  std::vector<Complex> offset_phase;    ///< exp(i element_offset 2 pi j / grid)
  std::vector<Complex> element;         ///< shading / deconvolution factor, by grid frequency; 0 without element
  std::vector<Real> beam_weight;        ///< beams x width
  std::vector<std::uint32_t> beam_row;  ///< beams x width
  SynthesisChoice choice;

  /// kernel_tolerance   error of the kernel relative to the gridded energy
  GriddingPlan(const SonarHead& head, const Medium& medium, double tolerance, double kernel_tolerance);

  std::size_t tiles() const { return (axis.bins + tile_bins - 1) / tile_bins; }

  /// Position of a direction on the grid: step, and sign due to whole cycles.
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
