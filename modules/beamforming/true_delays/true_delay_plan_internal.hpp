// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "beamforming/numerics/fft_internal.hpp"
#include "beamforming/numerics/gridding_kernel_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/pulses/time_axis_internal.hpp"
#include "beamforming/synthesize.hpp"

namespace insonify {

/// Returns the distance between the outermost elements [m].
double length_of(const LineArray& array);
/// Returns the largest frequency off the carrier that contributes [Hz]: there the spectrum falls to the tolerance.
double half_band_of(const Pulse& pulse, double tolerance);

/// Doppler shifts of the echoes that a plan is for [Hz].
struct DopplerSpan {
  double most = 0;    ///< largest |shift|
  double centre = 0;  ///< shift for which the change of the curvature over a pulse is undone
};

/// Sizes of the synthesis with true delays for blocks of time of one length. One cycle of a transform holds the pulses
/// of a block with all delays across the array. Directions lie on a grid over one period. Its harmonics k / period, |k|
/// <= most, are positions on the array in wavelengths; the elements are interpolated between these positions, frequency
/// by frequency.
struct TrueDelaySizes {
  static constexpr std::size_t kernel_width = 8;

  double tolerance;
  double widest;  ///< |u| of echoes and beams
  DopplerSpan doppler;
  TimeAxis axis;
  double cut;       ///< pulses are cut where they fall below this
  double aperture;  ///< length of the array [m]

  double half_band = 0;  ///< largest frequency off the carrier that contributes, of shifted echoes too [Hz]
  std::size_t block = 0, guard = 0, cycle = 0;  ///< bins: of the longest block, of its guard on either side, of a cycle
  std::size_t fine = 0, fine_row = 0;           ///< samples of a cycle before the beams are formed; allocated samples
  double fine_step = 0;                         ///< [s]
  double reach = 0;                             ///< half length of a pulse at the end of the gate [s]

  double period = 0;                      ///< period of the direction cosine
  std::size_t grid = 0, grid_stride = 0;  ///< steps of the period
  std::size_t most = 0;                   ///< harmonics run from -most to most, one row each
  std::size_t taps = 0;                   ///< rows that give an element

  /// `widest`: |u| of echoes; `block_bins`: length of a block asked for.
  TrueDelaySizes(const SonarHead& head, const Medium& medium, double tolerance, double widest, DopplerSpan doppler,
                 std::size_t block_bins);

  std::size_t rows() const { return 2 * most + 1; }
  /// Returns the position of a direction on the grid [steps].
  double column_of(double u) const { return (u / period + 0.5) * static_cast<double>(grid); }
  /// The frequency off the carrier of a line of the cycle, counted from 0 to fine [lines].
  double line_of(std::size_t line) const {
    return static_cast<double>(line) - (2 * line > fine ? static_cast<double>(fine) : 0.0);
  }
  double seconds() const { return static_cast<double>(fine) * fine_step; }
};

/// Constants of the synthesis with true delays for all blocks of time of one length.
struct TrueDelayPlan : TrueDelaySizes {
  static constexpr std::size_t moments = 12;
  static constexpr std::size_t fit_nodes = 32;    ///< frequencies at which functions are fitted by powers of frequency
  static constexpr std::size_t most_powers = 12;  ///< powers at most

  SonarHead head;
  Medium medium;
  EchoShapes shapes;
  std::vector<double> u_beam;
  std::vector<double> y;       ///< places of elements [m], positive to port
  double spectral_width2 = 0;  ///< a of a Gaussian pulse with the spectrum exp(-a f^2) [s^2]; 0: of a sweep

  GriddingKernel kernel;                ///< kernel of directions on the grid, and of places between harmonics
  PolynomialPieces<float> columns;      ///< polynomials of the kernel
  std::vector<double> position_factor;  ///< undoes the kernel between harmonics, by step of the grid
  std::vector<float> beam_weight;       ///< weights of kernel.width() grid steps for each beam
  std::vector<std::uint32_t> beam_row;

  std::vector<std::size_t> chunks;                ///< chunks of lines_at_once frequencies that contribute
  std::vector<std::uint32_t> tap_row;             ///< the first of the taps, by chunk and element
  Aligned<float> tap_weight;                      ///< weights of taps by chunk, element, tap and line
  Aligned<float> element_weight;                  ///< shading, with the kernel undone, by chunk, element and line
  double digits = 0;                              ///< decimal digits of the tolerance
  std::vector<double> node_frequency;             ///< off the carrier, against the sign of lines [Hz]
  std::vector<double> node_weight;                ///< weight of the spectrum there times that of the node
  std::vector<double> fit_frequency, fit_weight;  ///< frequencies [Hz] and weights where functions are fitted
  std::vector<double> fit_power;  ///< polynomials of frequency, orthonormal there by weight: node x power
  Aligned<float> line_power;      ///< the same at lines: by chunk, power and line

  /// Takes the arguments of TrueDelaySizes.
  TrueDelayPlan(const SonarHead& head, const Medium& medium, double tolerance, double widest, DopplerSpan doppler,
                std::size_t block_bins);

  /// Transforms of the kernel times x^j, x in its steps, j < moments; `frequency` in cycles per step.
  std::array<std::complex<double>, moments> kernel_moments(double frequency) const;
  double kernel_transform(double frequency) const;  ///< the first of them
  std::size_t elements() const { return y.size(); }

 private:
  void plan_directions();
  void plan_elements();
  void plan_band();

  std::vector<double> node_, node_weight_;  ///< for integrals of the kernel over positive x
};

/// Phase of the wavefront curvature at the ends of the array from broadside, at the highest frequency [rad]: `all` is
/// the whole phase; `over_range` is its change between two ranges, to either side of the mean.
struct CurvaturePhase {
  double all, over_range;

  CurvaturePhase(const SonarHead& head, const Medium& medium, double near, double far);
};

/// Division of time into blocks without gaps. The blocks begin where blocks keep the tolerance, or with the gate, and
/// end after the end of the gate. Longer blocks spend less on their ends, but the curvature changes more within them.
struct BlockLayout {
  struct Block {
    double first, last;  ///< first and one after the last bin
    std::size_t level;   ///< index into `levels` of the sizes for its length
  };
  double guard;  ///< bins by which a block extends beyond its ends, for the array's delays and the pulse
  double
      steady;  ///< largest Doppler shift for which blocks of echoes at rest keep it, but for the width of the band [Hz]
  std::vector<TrueDelaySizes> levels;
  std::vector<Block> blocks;

  BlockLayout(const SonarHead& head, const Medium& medium, double tolerance, double widest, DopplerSpan doppler);
};

/// Returns the part of an image of echoes of Doppler shift `shift` that a plan for echoes at rest leaves out at a range
/// (E191): the curvature changes over a pulse, and is undone as if the spectrum lay about the carrier. 0 for sweeps.
double doppler_error(const SonarHead& head, double shift, double range);

}  // namespace insonify
