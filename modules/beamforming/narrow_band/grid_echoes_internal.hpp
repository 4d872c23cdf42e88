#pragma once
#include <array>
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "acoustics/echoes.hpp"
#include "beamforming/narrow_band/gridding_plan_internal.hpp"
#include "beamforming/numerics/fft_along_rows_internal.hpp"

namespace insonify {

/// The echoes to grid and their pulses; the same for all tiles of one image.
struct GriddingInput {
  const Echoes& echoes;
  PulseReach reach;
  bool planned;     ///< all echoes have the planned pulse, times an amplitude
  double unit = 1;  ///< amplitudes are gridded in this unit [Pa]
};

constexpr std::size_t echo_batch = 128;  ///< echoes that are sampled and gridded at a time

/// Gaussian pulses of some echoes (E8): where they begin on a tile of the grid, and their samples, row by row: sample n
/// of echo i at n count + i.
template <typename Real>
struct GaussianBatch {
  std::array<std::uint32_t, echo_batch> row, column;
  std::array<Real, echo_batch> column_offset;
  std::vector<Real> re, im;

  /// Samples the listed echoes, at most echo_batch, for the tile that begins with bin `first_bin`; returns their energy
  /// [input.unit^2 bins].
  double sample(const GriddingPlan<Real>& plan, const GriddingInput& input, std::span<const std::uint32_t> list,
                std::size_t first_bin);
};

/// Working memory of one tile of bins: planes for gridding (with margin rows on both sides for samples that belong to
/// neighbouring tiles) and the grid for the transforms.
template <typename Real>
struct GridTile {
  AlignedArray<Real, Real> re, im;
  AlignedArray<std::complex<Real>, Real> grid;
  std::vector<Real> scratch, flushed_re, flushed_im;  ///< flushed: sums of earlier echoes
  GaussianBatch<Real> pulses;

  /// Refers to `plan`.
  explicit GridTile(const GriddingPlan<Real>& plan);

  std::size_t since_flush = 0;  ///< echoes added since partial sums were flushed
  /// Adds the planes to the flushed sums and clears them, which bounds the number of terms accumulated in single
  /// precision.
  void flush_partial_sums();
  /// Adds the flushed sums back to the planes: once, after the last echo.
  void restore_flushed_sums();
  /// Empties planes and flushed sums.
  void clear();

  /// Adds the listed echoes (E13), in order, to the tile that begins with bin `first_bin`; returns their energy
  /// [input.unit^2 bins].
  double add(const GriddingInput& input, std::span<const std::uint32_t> list, std::size_t first_bin);

 private:
  const GriddingPlan<Real>* plan_;
  std::size_t plane_;
};

}  // namespace insonify
