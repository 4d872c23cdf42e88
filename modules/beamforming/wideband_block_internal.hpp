#pragma once
#include <complex>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "acoustics/echoes.hpp"
#include "beamforming/fft_along_rows_internal.hpp"
#include "beamforming/wideband_bend_internal.hpp"
#include "beamforming/wideband_loops_internal.hpp"
#include "beamforming/wideband_plan_internal.hpp"
#include "core/grid.hpp"

namespace insonify {

constexpr std::size_t wideband_tile = 32;          ///< samples that are turned into harmonics at once
constexpr std::size_t wideband_tile_row = 32 + 8;  ///< numbers from one grid step to the next

/// The transforms of a plan.
struct WidebandTransforms {
  FftOfRows<float> to_harmonics, to_frequencies;
  FftAlongRows<float> to_directions, to_bins;

  explicit WidebandTransforms(const WidebandPlan& plan);
};

/// A block of time.
struct WidebandBlock {
  double first, last;           ///< bins of the gate; they may begin before it
  BendSeries received, undone;  ///< by echoes, and for beams

  WidebandBlock(const WidebandPlan& plan, double first, double last);
};

/// Room of one thread for one block.
class WidebandRoom {
 public:
  WidebandRoom(const WidebandPlan& plan, const WidebandTransforms& transforms);

  using List = std::span<const std::uint32_t>;

  /// Begins a block without echoes.
  void begin(const WidebandBlock& block);
  /// Adds echoes of the block, those of `list`; calls may follow one another, with the same bits as one of all echoes.
  void add(const Echoes& echoes, List list);
  /// Adds the beams of the block to `pressure`, within a guard of it.
  void add_image(const WidebandBlock& block, ComplexGrid& pressure);

 private:
  using Complex = std::complex<float>;
  using Spectrum = AlignedArray<Complex, float>;

  // Gaussian pulses that are alike, those that are not, and sweeps, sample by sample.
  void grid_alike(const Echoes& echoes, List list);
  void grid_gaussians(const Echoes& echoes, List list);
  void grid_sweeps(const Echoes& echoes, List list);
  /// Fine samples that hold something.
  void touch(std::size_t row, std::size_t rows);
  /// What harmonics receive of one term of the bend, by chunk of frequencies.
  void receive_term(const BendSeries& bend, std::size_t term, float* lines);
  void gather_elements(const BendSeries& bend);
  /// What elements received, as each term of the bend undoes it: bins of all harmonics.
  void form_beam_terms(const BendSeries& bend);
  /// Calls visit(chunk, term, taps, turns, x) for some elements of every chunk of frequencies that counts, by its number
  /// among those, and all terms, so that what interpolates these elements stays in the cache; then done(chunk).
  template <typename Visit, typename Done>
  void each_chunk(const BendSeries& bend, Visit&& visit, Done&& done);
  /// Begins with so many terms.
  void make_room(std::size_t terms);
  void add_beams(const WidebandBlock& block, ComplexGrid& pressure);

  const WidebandPlan& plan_;
  const WidebandTransforms& transforms_;
  AlignedArray<float, float> re_, im_;           ///< fine samples x grid_stride
  Spectrum tile_, harmonics_;                    ///< some samples by direction, and by harmonic
  Spectrum spectrum_, row_;                      ///< harmonics x fine samples, and one of them by frequency
  std::vector<std::unique_ptr<Spectrum>> term_;  ///< of each: by chunk, harmonic and line; then harmonics x bins
  AlignedFloats elements_;                       ///< by chunk and element
  AlignedFloats chunk_;                          ///< of one chunk: by term and harmonic
  AlignedFloats start_, step_, line_;            ///< of one chunk and element group: by term and element
  std::vector<std::complex<double>> carrier_, turn_, now_;
  std::vector<float> scratch_, samples_, sums_;
  std::vector<double> pulse_re_, pulse_im_;
  std::vector<char> touched_;  ///< tiles of fine samples that hold anything
  std::size_t bins_row_;
  double start_time_ = 0, unit_ = 0;  // unit: a power of two, of the first echoes; 0: none yet
};

}  // namespace insonify
