#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "beamforming/flush_denormals_internal.hpp"
#include "beamforming/gridded_synthesis_internal.hpp"
#include "beamforming/time_axis_internal.hpp"
#include "beamforming/windowed_sum_internal.hpp"
#include "core/parallel.hpp"

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

/// Returns the largest amplitude after absorption [Pa], rounded to a power of two, the unit of gridding in single
/// precision; 1 if all are 0.
double largest(const Echoes& echoes, const Medium& medium, int threads) {
  constexpr std::size_t block = 4096;
  std::vector<double> most((echoes.size() + block - 1) / block, 0);
  parallel_blocks(echoes.size(), block, threads, [&](std::size_t begin, std::size_t end) {
    double& here = most[begin / block];
    for (std::size_t i = begin; i < end; ++i)
      here = std::max(
          here, std::abs(echoes.amplitude[i]) * std::exp(-medium.absorption.a0 * medium.sound_speed * echoes.delay[i]));
  });
  const double all = most.empty() ? 0 : *std::max_element(most.begin(), most.end());
  return all > std::numeric_limits<double>::min() ? std::exp2(std::round(std::log2(all))) : 1;
}

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

/// Lists of the echoes that overlap each tile of bins, in order of echoes, for any number of threads.
struct TileLists {
  std::vector<std::size_t> begin;   ///< tiles + 1 offsets into `echo`
  std::vector<std::uint32_t> echo;  ///< indices of echoes, fewer than 2^32

  TileLists(const Echoes& echoes, const TimeAxis& axis, const PulseReach& reach, std::size_t tile_bins, int threads);

  std::size_t tiles() const { return begin.size() - 1; }
  std::span<const std::uint32_t> of(std::size_t tile) const {
    return {echo.data() + begin[tile], begin[tile + 1] - begin[tile]};
  }
};

constexpr std::size_t min_block = 4096;  // least number of echoes per block of work
constexpr std::size_t max_blocks = 256;

/// Calls visit(tile, i) for every tile that the pulse of echo i in [begin, end) overlaps.
template <typename Visit>
void each_tile(const Echoes& echoes, const TimeAxis& axis, const PulseReach& reach, std::size_t tile_bins,
               std::size_t begin, std::size_t end, Visit&& visit) {
  for (std::size_t i = begin; i < end; ++i) {
    const auto [first, last] = axis.around(echoes.delay[i], reach.at(echoes.delay[i]));
    for (std::size_t t = first / tile_bins; first < last && t <= (last - 1) / tile_bins; ++t) visit(t, i);
  }
}

TileLists::TileLists(const Echoes& echoes, const TimeAxis& axis, const PulseReach& reach, std::size_t tile_bins,
                     int threads) {
  const std::size_t tiles = (axis.bins + tile_bins - 1) / tile_bins;
  const std::size_t block = std::max(min_block, (echoes.size() + max_blocks - 1) / max_blocks);
  const std::size_t blocks = (echoes.size() + block - 1) / block;

  // Count the entries of each block of echoes in each tile.
  std::vector<std::size_t> next(blocks * tiles, 0);
  parallel_blocks(echoes.size(), block, threads, [&](std::size_t first, std::size_t last) {
    std::size_t* count = next.data() + first / block * tiles;
    each_tile(echoes, axis, reach, tile_bins, first, last, [&](std::size_t t, std::size_t) { ++count[t]; });
  });

  // Assign positions tile by tile, within a tile block by block, so the lists do not depend on the division into
  // blocks.
  begin.assign(1, 0);
  std::size_t place = 0;
  for (std::size_t t = 0; t < tiles; ++t) {
    for (std::size_t k = 0; k < blocks; ++k) {
      const std::size_t count = next[k * tiles + t];
      next[k * tiles + t] = place;
      place += count;
    }
    begin.push_back(place);
  }

  echo.resize(place);
  parallel_blocks(echoes.size(), block, threads, [&](std::size_t first, std::size_t last) {
    std::size_t* to = next.data() + first / block * tiles;
    each_tile(echoes, axis, reach, tile_bins, first, last,
              [&](std::size_t t, std::size_t i) { echo[to[t]++] = static_cast<std::uint32_t>(i); });
  });
}

/// Returns the number of tiles that some pulse overlaps, i.e. whose TileLists entry is not empty.
std::size_t touched_tiles(const Echoes& echoes, const TimeAxis& axis, const PulseReach& reach, std::size_t tile_bins) {
  std::vector<bool> touched((axis.bins + tile_bins - 1) / tile_bins, false);
  each_tile(echoes, axis, reach, tile_bins, 0, echoes.size(), [&](std::size_t t, std::size_t) { touched[t] = true; });
  return static_cast<std::size_t>(std::count(touched.begin(), touched.end(), true));
}

}  // namespace

template <typename Real>
GriddedSynthesis<Real>::GriddedSynthesis(const SonarHead& head, const Medium& medium, const SynthesisOptions& options,
                                         double kernel_tolerance)
    : plan_(head, medium, options.tolerance, kernel_tolerance),
      threads_(options.threads),
      to_elements_(plan_.grid, plan_.tile_bins, plan_.grid_row, FFTW_BACKWARD),
      to_beams_(plan_.grid, plan_.tile_bins, plan_.grid_row, FFTW_FORWARD) {
  const double most = SynthesisCost(head, plan_.choice, plan_.tile_bins, plan_.common_shape).break_even(plan_.tiles());
  plan_.choice.direct_echoes = static_cast<std::size_t>(std::min(most, 1e15));
}

template <typename Real>
GriddingInput GriddedSynthesis<Real>::input_for(const Echoes& echoes) const {
  const bool moving = !echoes.doppler.empty(), planned = plan_.common_shape && !moving;
  PulseReach reach(plan_.head.pulse, plan_.medium.absorption, plan_.medium.sound_speed, moving, plan_.cut);
  if (planned) reach.half = plan_.half;
  return {echoes, reach, planned};
}

template <typename Real>
bool GriddedSynthesis<Real>::direct_is_cheaper(const Echoes& echoes) const {
  const GriddingInput input = input_for(echoes);
  const SynthesisCost cost(plan_.head, plan_.choice, plan_.tile_bins, input.planned);
  // Fewer overlapped tiles can only make gridding cheaper.
  if (!cost.direct_is_cheaper(echoes.size(), plan_.tiles())) return false;
  return cost.direct_is_cheaper(echoes.size(), touched_tiles(echoes, plan_.axis, input.reach, plan_.tile_bins));
}

template <typename Real>
bool GriddedSynthesis<Real>::direct_is_cheaper(std::size_t echoes) const {
  return SynthesisCost(plan_.head, plan_.choice, plan_.tile_bins, plan_.common_shape)
      .direct_is_cheaper(echoes, plan_.tiles());
}

template <typename Real>
GriddedImage GriddedSynthesis<Real>::image(const Echoes& echoes) const {
  GriddingInput input = input_for(echoes);
  input.unit = largest(echoes, plan_.medium, threads_);
  const TileLists lists(echoes, plan_.axis, input.reach, plan_.tile_bins, threads_);
  ComplexGrid pressure(plan_.head.fan.beams(), plan_.axis.bins);
  std::vector<double> gridded(lists.tiles()), received(lists.tiles());
  // Each tile of bins is computed by one thread, which grids its echoes in order and forms its beams.
  parallel_for(lists.tiles(), threads_, [&](std::size_t t) {
    const std::size_t first = t * plan_.tile_bins, last = std::min(first + plan_.tile_bins, plan_.axis.bins);
    auto bins = pressure.middleCols(first, last - first);
    if (lists.of(t).empty()) {
      bins.setZero();
      return;
    }
    const FlushDenormals flush;
    GridTile<Real> tile(plan_);
    gridded[t] = grid_echoes(plan_, input, lists.of(t), first, tile);
    tile.restore_flushed_sums();
    form_beams(tile, first, last, pressure);
    received[t] = bins.abs2().sum();
    bins *= input.unit;
  });
  const double all = std::accumulate(gridded.begin(), gridded.end(), 0.0) * static_cast<double>(plan_.head.fan.beams());
  const double share = all > 0 ? std::sqrt(std::accumulate(received.begin(), received.end(), 0.0) / all) : 1;
  return {std::move(pressure), share};
}

template <typename Real>
void GriddedSynthesis<Real>::wrap_and_transpose(GridTile<Real>& tile) const {
  // The grid is periodic: columns beyond either end are added at the other end.
  const Real sign = plan_.element_offset != 0 ? Real(-1) : Real(1);
  for (std::size_t n = plan_.margin; n < plan_.margin + plan_.tile_bins; ++n)
    for (Real* plane : {tile.re.data() + n * plan_.stride, tile.im.data() + n * plan_.stride})
      for (std::size_t j = 0; j < grid_pad; ++j) {
        plane[plan_.grid + j] += sign * plane[j];
        plane[grid_pad + j] += sign * plane[grid_pad + plan_.grid + j];
      }
  // Transpose to one row per grid step, so transforms and sums run along time.
  constexpr std::size_t square = 16;
  for (std::size_t n0 = 0; n0 < plan_.tile_bins; n0 += square)
    for (std::size_t j = 0; j < plan_.grid; ++j)
      for (std::size_t n = n0; n < n0 + square; ++n) {
        const std::size_t at = (plan_.margin + n) * plan_.stride + grid_pad + j;
        const Real a = tile.re[at], b = tile.im[at], c = plan_.offset_phase[j].real(), d = plan_.offset_phase[j].imag();
        tile.grid[j * plan_.grid_row + n] = Complex(a * c - b * d, a * d + b * c);
      }
}

template <typename Real>
void GriddedSynthesis<Real>::form_beams(GridTile<Real>& tile, std::size_t first, std::size_t last,
                                        ComplexGrid& pressure) const {
  wrap_and_transpose(tile);
  to_elements_.run(tile.grid.data());
  for (std::size_t j = 0; j < plan_.grid; ++j)
    for (std::size_t n = 0; n < plan_.tile_bins; ++n) tile.grid[j * plan_.grid_row + n] *= plan_.element[j].real();
  to_beams_.run(tile.grid.data());
  for (std::size_t j = 0; j < plan_.grid; ++j) {
    const Real c = plan_.offset_phase[j].real(), d = -plan_.offset_phase[j].imag();
    for (std::size_t n = 0; n < plan_.tile_bins; ++n) {
      Complex& x = tile.grid[j * plan_.grid_row + n];
      x = Complex(x.real() * c - x.imag() * d, x.real() * d + x.imag() * c);
    }
  }
  const std::size_t width = plan_.kernel.width();
  const Real* rows = reinterpret_cast<const Real*>(tile.grid.data());
  for (Eigen::Index b = 0; b < pressure.rows(); ++b)
    kernels::interpolate(plan_.beam_weight.data() + b * width, plan_.beam_row.data() + b * width, width, rows,
                         2 * plan_.grid_row, 2 * (last - first), reinterpret_cast<double*>(&pressure(b, first)));
}

template class GriddedSynthesis<float>;
template class GriddedSynthesis<double>;

}  // namespace insonify
