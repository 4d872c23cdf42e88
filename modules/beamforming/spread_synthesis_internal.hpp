#pragma once
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "beamforming/fft_along_rows_internal.hpp"
#include "beamforming/ping_synthesizer.hpp"
#include "beamforming/spreading_kernel_internal.hpp"
#include "beamforming/time_axis_internal.hpp"

namespace insonify {

/// An image, and how much of what was stamped is in it.
struct SpreadImage {
  ComplexGrid pressure;  ///< beams x bins [Pa]
  /// Root of the mean energy of a beam over that of all stamped pulses: 0.1 for a fan of 500 beams of which 5 hear an
  /// echo. The errors of the kernel go into all beams alike; the smaller this is, the more they weigh.
  double share = 0;
};

/// The work of PingSynthesizer in one precision. Directions are counted as phase from one element to the next, in cycles;
/// a grid of `grid_` steps covers one cycle. Elements stand at whole places for odd numbers of them and at half
/// ones for even numbers: then everything changes sign from one cycle to the next.
template <typename Real>
class SpreadSynthesis {
 public:
  /// kernel_tolerance: error of the kernel relative to what is stamped.
  SpreadSynthesis(const SonarHead& head, const Medium& medium, const SynthesisOptions& options,
                  double kernel_tolerance);
  SpreadImage image(const Echoes& echoes) const;
  const SynthesisChoice& choice() const { return choice_; }

 private:
  using Complex = std::complex<Real>;
  struct Tile;

  void plan_time(const SynthesisOptions& options, double kernel_tolerance);
  void plan_elements();
  void plan_beams();

  /// Which echoes, and how their pulses look: the same for all tiles of one ping.
  struct Ping {
    const Echoes& echoes;
    PulseReach reach;
    bool planned;  ///< every echo has the planned pulse, times a factor
    double unit;   ///< what is stamped is counted in this [Pa]
  };
  /// Stamps the listed echoes on one tile of bins; returns their energy [Pa^2 bins].
  double stamp(const Ping& ping, std::span<const std::uint32_t> list, std::size_t first_bin, Tile& tile) const;
  /// The same for sweeps: only what falls on the tile of each.
  double stamp_sweeps(const Ping& ping, std::span<const std::uint32_t> list, std::size_t first_bin, Tile& tile) const;
  /// The same for echoes whose pulses differ: sample by sample.
  double stamp_singly(const Ping& ping, std::span<const std::uint32_t> list, std::size_t first_bin, Tile& tile) const;
  /// Turns the stamped tile into beams: the bins [first, last) of `pressure`.
  void form_beams(Tile& tile, std::size_t first, std::size_t last, ComplexGrid& pressure) const;
  void unfold(Tile& tile) const;

  /// Where a direction lies on the grid: step, and the sign that whole cycles bring along.
  struct Place {
    double step, sign;
  };
  Place place_of(double u) const;

  const SonarHead& head_;
  Medium medium_;
  int threads_;
  SynthesisChoice choice_;

  TimeAxis axis_;
  double cut_;  ///< pulses are cut where they fall below this
  EchoShapes shapes_;
  bool one_shape_;  ///< absorption leaves every pulse its shape: samples are polynomials of its offset from the bins
  SpreadingKernel kernel_;
  PolynomialPieces<Real> columns_, rows_, rows_im_;  ///< rows_im_: of a sweep
  bool sweep_ = false, sweep_ends_ = false;          ///< one_shape_ of a sweep; its ends are among the rows
  double half_ = 0;                                  ///< of what is planned of a pulse [s]
  double pulse_energy_ = 0;                          ///< of the planned pulse with unit peak [bins]
  std::size_t grid_, margin_, stride_, tile_bins_, tile_rows_;
  double cycles_per_u_, half_place_;

  std::vector<Complex> half_turn_;       ///< exp(i half_place 2 pi j / grid)
  std::vector<Complex> element_;         ///< shading, deconvolution: by grid frequency; 0 where no element is
  std::vector<Real> beam_weight_;        ///< beams x width
  std::vector<std::uint32_t> beam_row_;  ///< beams x width
  FftAlongRows<Real> to_elements_, to_beams_;
};

}  // namespace insonify
