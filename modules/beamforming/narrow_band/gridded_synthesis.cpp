#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "beamforming/narrow_band/gridded_synthesis_internal.hpp"
#include "beamforming/narrow_band/tile_lists_internal.hpp"
#include "beamforming/narrow_band/windowed_sum_internal.hpp"

// Gridded synthesis (E13): non-uniform FFTs over the array, bin by bin, after Barnett, Magland, af Klinteberg (2019).
//   1. gridding: each echo adds its pulse, cut at the tolerance, times the kernel (E60) to a grid over direction with
//      an oversampling factor of 2; in tiles of bins, each tile by one thread (grid_echoes, gridding_loops);
//   2. transform: per bin an FFT turns the grid into element series (type 1);
//   3. deconvolution and shading: one real factor per element, with 1 / (kernel transform)^2 for both transforms;
//   4. transform back, and interpolation with the same kernel to the beam directions (type 2).
// Cost: echoes x pulse samples x kernel width + bins x (grid log grid + beams x kernel width). No transform runs along
// range: nothing wraps around, and errors are local in range. Kernel width and precision follow from the tolerance and
// the fraction of the gridded energy that the beams receive (ping_synthesizer).
namespace insonify {
namespace {

/// Cost model of the two synthesis methods beyond that of a silent image, in nanoseconds of one core; only the ratio
/// matters. The constants are fitted to 26 heads and tolerances timed on one machine, accurate to 30 % there;
/// `insonify_benchmarks --benchmark_filter=few_echoes` measures both methods.
struct SynthesisCost {
  double tile;          ///< gridded: transform and interpolation of one tile of bins
  double gridded_echo;  ///< gridded: one echo
  double direct_fixed;  ///< direct: steering of all beams, and test for cancellation
  double direct_echo;   ///< direct: one echo in all beams
  double direct_block;  ///< direct: patterns of all beams for one block of echoes, full or not

  /// choice         parameters of the gridded synthesis
  /// common_shape   all pulses have the same shape and are gridded from polynomials
  SynthesisCost(const SonarHead& head, const SynthesisChoice& choice, std::size_t tile_bins, bool common_shape);

  /// tiles   number of tiles that the echoes overlap
  bool direct_is_cheaper(std::size_t echoes, std::size_t tiles) const;
  /// Returns the number of echoes above which gridding is cheaper, if they overlap `tiles` tiles.
  double break_even(std::size_t tiles) const;
};

SynthesisCost::SynthesisCost(const SonarHead& head, const SynthesisChoice& choice, std::size_t tile_bins,
                             bool common_shape) {
  const auto beams = static_cast<double>(head.fan.beams()), elements = static_cast<double>(head.array.elements());
  const auto bins = static_cast<double>(head.gate.bins()), grid = static_cast<double>(choice.grid);
  const auto samples = std::min(static_cast<double>(choice.pulse_samples), bins);
  const double precision = choice.single_precision ? 0.5 : 1, lanes = choice.kernel_width > 8 ? 16 : 8;
  const double width = precision * static_cast<double>(choice.kernel_width);
  const double out_of_cache = choice.bytes_per_thread > 0x100000 ? 7.5 : 0;

  // Transforms, interpolation of beams, and writing them, minus the cost of a silent tile.
  tile = static_cast<double>(tile_bins) *
         (grid * (0.3 * std::log2(grid) + 1.7 * precision + out_of_cache) + beams * (0.31 * width + 4.4));
  gridded_echo = 70 + samples * (precision * lanes + (common_shape ? 0 : 20));
  direct_fixed = beams * (0.32 * elements + 0.3 * bins);
  direct_echo = 0.46 * elements + 20 * samples + beams * (0.39 * samples + 0.9);
  direct_block = 0.37 * static_cast<double>(WindowedSum::block) * beams * elements;
}

bool SynthesisCost::direct_is_cheaper(std::size_t echoes, std::size_t tiles) const {
  const auto n = static_cast<double>(echoes);
  const auto blocks = static_cast<double>((echoes + WindowedSum::block - 1) / WindowedSum::block);
  return direct_fixed + blocks * direct_block + n * direct_echo <= static_cast<double>(tiles) * tile + n * gridded_echo;
}

double SynthesisCost::break_even(std::size_t tiles) const {
  const double extra_per_echo = direct_echo + direct_block / static_cast<double>(WindowedSum::block) - gridded_echo;
  if (extra_per_echo <= 0) return std::numeric_limits<double>::infinity();
  return std::max(0.0, (static_cast<double>(tiles) * tile - direct_fixed) / extra_per_echo);
}

}  // namespace

template <typename Real>
GriddedSynthesis<Real>::GriddedSynthesis(const SonarHead& head, const Medium& medium, const SynthesisOptions& options,
                                         double kernel_tolerance)
    : plan_(head, medium, options.tolerance, kernel_tolerance),
      threads_(options.threads),
      to_beams_(plan_),
      beams_(head.fan.beams()),
      tiles_([this] { return std::make_unique<GridTile<Real>>(plan_); }) {
  std::iota(beams_.begin(), beams_.end(), 0);
  const double most = SynthesisCost(head, plan_.choice, plan_.tile_bins, plan_.common_shape).break_even(plan_.tiles());
  plan_.choice.direct_echoes = static_cast<std::size_t>(std::min(most, 1e15));
}

template <typename Real>
PulseReach GriddedSynthesis<Real>::reach_of(bool moving) const {
  PulseReach reach(plan_.head.pulse, plan_.medium.absorption, plan_.medium.sound_speed, moving, plan_.cut);
  if (plan_.common_shape && !moving) reach.half = plan_.half;
  return reach;
}

template <typename Real>
bool GriddedSynthesis<Real>::direct_is_cheaper(const Echoes& echoes) const {
  const bool moving = !echoes.doppler.empty();
  const SynthesisCost cost(plan_.head, plan_.choice, plan_.tile_bins, plan_.common_shape && !moving);
  // Fewer overlapped tiles can only make gridding cheaper.
  if (!cost.direct_is_cheaper(echoes.size(), plan_.tiles())) return false;
  return cost.direct_is_cheaper(echoes.size(), touched_tiles(echoes, plan_.axis, reach_of(moving), plan_.tile_bins));
}

template <typename Real>
bool GriddedSynthesis<Real>::direct_is_cheaper(std::size_t echoes) const {
  return SynthesisCost(plan_.head, plan_.choice, plan_.tile_bins, plan_.common_shape)
      .direct_is_cheaper(echoes, plan_.tiles());
}

template class GriddedSynthesis<float>;
template class GriddedSynthesis<double>;

}  // namespace insonify
