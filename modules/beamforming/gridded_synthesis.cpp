#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "beamforming/flush_denormals_internal.hpp"
#include "beamforming/gridded_synthesis_internal.hpp"
#include "beamforming/synthesis_cost_internal.hpp"
#include "beamforming/tile_lists_internal.hpp"
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

/// Returns the largest amplitude after absorption [Pa], the unit of gridding in single precision; 1 if all are 0.
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
  return all > std::numeric_limits<double>::min() ? all : 1;
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
