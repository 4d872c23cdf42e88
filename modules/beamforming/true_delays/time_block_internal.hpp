// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "acoustics/echoes.hpp"
#include "beamforming/numerics/fft_internal.hpp"
#include "beamforming/pulses/gaussian_batch_internal.hpp"
#include "beamforming/true_delays/curvature_series_internal.hpp"
#include "beamforming/true_delays/true_delay_loops_internal.hpp"
#include "beamforming/true_delays/true_delay_plan_internal.hpp"
#include "core/grid.hpp"

namespace insonify {

constexpr std::size_t time_tile =
    kernels::times_at_once;  ///< samples whose directions are turned into harmonics at once

/// The transforms of a plan.
struct BlockTransforms {
  Fft<float> to_harmonics, to_frequencies, to_bins, to_directions;

  explicit BlockTransforms(const TrueDelayPlan& plan);
};

/// A block of time.
struct TimeBlock {
  double first, last;                              ///< bins of the gate; they may begin before it
  CurvatureSeries echo_curvature, beam_curvature;  ///< curvature as echoes have it, and as beams undo it

  TimeBlock(const TrueDelayPlan& plan, const RowFits& fits, double first, double last);
};

/// Workspace of one thread for one block.
class BlockWorkspace {
 public:
  BlockWorkspace(const TrueDelayPlan& plan, const BlockTransforms& transforms);

  using List = std::span<const std::uint32_t>;

  /// Begins a block without echoes.
  void begin(const TimeBlock& block);
  /// Adds the echoes of `list`, which lie in the block. Several calls give the same bits as one call with all echoes.
  void add(const Echoes& echoes, List list);
  /// Adds the beams of the block to `pressure`, in the bins of the block and of a guard on either side.
  void add_image(const TimeBlock& block, ComplexGrid& pressure);

 private:
  using Complex = std::complex<float>;
  using Numbers = Aligned<Complex>;

  // At most GaussianBatch::most Gaussian pulses, and sweeps, sample by sample.
  void grid_gaussians(const Echoes& echoes, List list);
  void grid_sweeps(const Echoes& echoes, List list);
  /// Turns the gridded echoes into harmonics, by power of frequency and fine sample.
  void receive(const CurvatureSeries& curvature);
  /// Transforms the harmonics over time into chunks of frequencies.
  void to_chunks(const CurvatureSeries& curvature);
  /// Interpolates the elements from the harmonics of each chunk and adds them to the harmonics of the beams.
  void through_elements();
  /// Transforms the chunks back to time, by power of frequency and bin.
  void to_bins(const CurvatureSeries& curvature);
  void add_beams(const TimeBlock& block, ComplexGrid& pressure);
  /// Forms the grid of directions at the bins from n0 on in across_, with the curvature undone; `first` is the bin of
  /// n0.
  void form_directions(const CurvatureSeries& curvature, std::size_t n0, double first);
  /// A tile by direction or harmonic, and rows of harmonics from time `n0` on.
  kernels::TimePlanes planes_of(Numbers& numbers) const;
  kernels::PositionRows rows_of(Numbers& numbers, std::size_t length, std::size_t n0) const;

  const TrueDelayPlan& plan_;
  const BlockTransforms& transforms_;
  Aligned<float> re_, im_;               ///< fine samples x grid_stride; 0 between images
  Numbers tile_;                         ///< some samples by direction
  Numbers harmonics_, directions_;       ///< some samples by harmonic or direction, of each term
  Numbers spectrum_, row_;               ///< powers x harmonics x fine samples, and one harmonic by frequency
  Numbers bins_, bin_row_;               ///< powers x harmonics x bins, and one harmonic
  Aligned<float> lines_, chunk_;         ///< numbers by chunk, harmonic and line; those of one chunk, or one harmonic
  Aligned<float> across_, mixed_;        ///< numbers by grid step and bin; workspace of mixes
  std::vector<std::uint32_t> position_;  ///< rows of harmonics of a transform
  std::vector<std::uint32_t> bin_;       ///< first of each chunk
  std::vector<double> beam_;
  GaussianBatch<float> pulses_;
  std::vector<float> pulse_re_, pulse_im_;
  std::vector<char> touched_;  ///< tiles of fine samples that hold anything
  std::size_t bins_row_;
  double start_time_ = 0, unit_ = 0;  // unit: a power of two, of the first echoes; 0: none yet
};

}  // namespace insonify
