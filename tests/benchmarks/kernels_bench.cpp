// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of the synthesis by spreading, alone and in one thread.
#include <vector>

#include <benchmark/benchmark.h>

#include "beamforming/gridded/gridding_loops_internal.hpp"
#include "beamforming/numerics/fft_internal.hpp"
#include "beamforming/numerics/gridding_kernel_internal.hpp"
#include "beamforming/pulses/pulse_loops_internal.hpp"
#include "core/random.hpp"

using namespace insonify;

namespace {

constexpr std::size_t grid = 216, stride = grid + 32, tile_rows = 64 + 40, echoes = 2048;

/// Echoes at random places of a tile, and samples of their pulses.
template <typename Real>
struct Pulses {
  std::vector<std::uint32_t> row, column;
  std::vector<Real> column_offset, re, im;

  explicit Pulses(std::size_t rows) : re(rows * echoes, Real(0.5)), im(rows * echoes, Real(0.25)) {
    for (std::size_t i = 0; i < echoes; ++i) {
      const auto at = random_uniform(1, RandomStage::noise, {i, 0, 0});
      row.push_back(static_cast<std::uint32_t>(at[0] * static_cast<double>(tile_rows - rows)));
      column.push_back(static_cast<std::uint32_t>(at[1] * grid));
      column_offset.push_back(static_cast<Real>(2 * at[3] - 1));
    }
  }
};

/// Grids one echo after another onto one tile: argument 0 is the number of digits of the kernel.
template <typename Real>
void grid_tile(benchmark::State& state) {
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  const GriddingKernel kernel(tolerance);
  const std::size_t rows = 10 + 2 * static_cast<std::size_t>(state.range(0));
  const PolynomialPieces<Real> across = kernel.pieces<Real>(tolerance);
  Pulses<Real> pulses(rows);
  Aligned<Real> re(tile_rows * stride), im(tile_rows * stride);
  for (auto _ : state) {
    kernels::grid_samples(
        kernels::GaussianPositions<Real>{pulses.row.data(), pulses.column.data(), pulses.column_offset.data()}, echoes,
        pulses.re.data(), pulses.im.data(), rows, across, re.data(), im.data(), stride);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * echoes));
  state.counters["width"] = static_cast<double>(kernel.width());
  state.counters["rows"] = static_cast<double>(rows);
}
BENCHMARK(grid_tile<float>)->Arg(2)->Arg(4)->Arg(6);
BENCHMARK(grid_tile<double>)->Arg(4)->Arg(8)->Arg(12);

/// Interpolates 512 beams out of one tile of 64 bins: argument 0 is the width of the kernel.
template <typename Real>
void interpolate(benchmark::State& state) {
  constexpr std::size_t beams = 512, bins = 64;
  const auto width = static_cast<std::size_t>(state.range(0));
  const std::vector<Real> weight(width, Real(0.1)), rows(grid * 2 * bins, Real(1));
  std::vector<std::uint32_t> row(width);
  std::vector<double> sum(2 * bins);
  for (auto _ : state)
    for (std::size_t b = 0; b < beams; ++b) {
      for (std::size_t k = 0; k < width; ++k) row[k] = static_cast<std::uint32_t>((b * 7 + k) % grid);
      kernels::interpolate(weight.data(), row.data(), width, rows.data(), 2 * bins, 2 * bins, sum.data());
      benchmark::DoNotOptimize(sum.data());
    }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * beams * bins));
}
BENCHMARK(interpolate<float>)->Arg(5)->Arg(8);
BENCHMARK(interpolate<double>)->Arg(8)->Arg(14);

/// Transforms one tile: argument 0 is its length, 64 series side by side.
template <typename Real>
void fft_along_rows(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const Fft<Real> fft({n, 64, 64, 1}, FFTW_FORWARD);
  Aligned<std::complex<Real>> data(n * 64);
  for (auto _ : state) {
    fft.run(data.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * n * 64));
}
BENCHMARK(fft_along_rows<float>)->Arg(216)->Arg(1024);
BENCHMARK(fft_along_rows<double>)->Arg(216)->Arg(1024);

void draw_complex_normal(benchmark::State& state) {
  std::uint64_t id = 0;
  for (auto _ : state) benchmark::DoNotOptimize(random_complex_normal(1, RandomStage::surface_amplitude, {id++, 0, 0}));
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
}
BENCHMARK(draw_complex_normal);

}  // namespace
