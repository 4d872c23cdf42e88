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

/// Gaussian pulses of some echoes (E8) on a grid of samples by direction: where they begin, and their samples, row by
/// row: sample n of echo i at n count + i.
template <typename Real>
struct GaussianBatch {
  static constexpr std::size_t most = 128;  ///< echoes
  std::array<std::uint32_t, most> row, column;
  std::array<Real, most> column_offset;
  std::vector<Real> re, im;

  /// Samples the listed echoes, at most `most` of them, `rows` samples each, in this unit of pressure [Pa]; returns the
  /// sum of the squares of their peaks after absorption at the carrier [unit^2]. Throws Error if absorption lets a
  /// pulse grow.
  double sample(const kernels::GaussianGrid& grid, const EchoShapes& shapes, const Echoes& echoes,
                std::span<const std::uint32_t> list, double unit, std::size_t rows);
  kernels::GaussianPlaces<Real> places() { return {row.data(), column.data(), column_offset.data()}; }
};

}  // namespace insonify
