// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "acoustics/echoes.hpp"
#include "beamforming/pulses/pulse_loops_internal.hpp"
#include "sonar/pulse.hpp"
#include "sonar/water.hpp"

namespace insonify {

/// Gaussian pulses of up to `most` echoes (E8) on a grid of samples by direction. `row`, `column` and `column_offset`
/// say where each pulse begins. `re` and `im` hold the samples row by row: sample n of echo i is at n count + i.
template <typename Real>
struct GaussianBatch {
  static constexpr std::size_t most = 128;  ///< echoes
  std::array<std::uint32_t, most> row, column;
  std::array<Real, most> column_offset;
  std::vector<Real> re, im;

  /// Samples the listed echoes, at most `most`, with `rows` samples each in units of `unit` [Pa]. Returns the sum of
  /// the squared peaks after absorption at the carrier [unit^2]. Throws Error if absorption lets a pulse grow.
  double sample(const kernels::GaussianGrid& grid, const EchoShapes& shapes, const Medium& medium, const Echoes& echoes,
                std::span<const std::uint32_t> list, double unit, std::size_t rows);
  kernels::GaussianPositions<Real> positions() { return {row.data(), column.data(), column_offset.data()}; }
};

}  // namespace insonify
