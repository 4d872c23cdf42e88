// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sampling/sampled_cells.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// Energy received from a surfel, the surfel's range [m] and u = cos(elevation) sin(azimuth), and its extent in both.
struct ReceivedSurfel {
  double energy, range, half_depth, u, half_u;
  std::uint8_t beyond;  ///< bits of SamplingOptions::inner_sector: 1 beyond its cones, 2 beyond its elevations
};

/// The energy received from each cell of range and u (E127). A cell is a main lobe wide in u; for one beam, which adds
/// up all directions, it holds all of u.
class EnergyShares {
 public:
  /// Adds the energy of each surfel in equal parts to the cells that it spans; a surfel smaller than a cell counts in
  /// the cell of its middle. A fixed number of sums is made in the order of the surfels; the result depends neither on
  /// threads nor on sorting.
  EnergyShares(std::span<const ReceivedSurfel> surfels, const RangeGate& gate, const SampledCells& cells, int threads);

  /// Returns the sum of the surfel's shares of the energy of the cells that it spans. A cell is one range resolution
  /// long and cells.width_of_shares() wide, and counts surfels that are beyond the inner sector only where this one is.
  /// The sum is infinite if the surfel spans more than 256 cells.
  double share(const ReceivedSurfel& surfel) const;

 private:
  using Span = std::pair<std::size_t, std::size_t>;  // first and last
  struct Cells {
    Span range, u;
    std::size_t number() const { return (range.second - range.first + 1) * (u.second - u.first + 1); }
  };
  Cells spanned(const ReceivedSurfel& surfel) const;
  void add(const ReceivedSurfel& surfel, std::vector<double>& energy) const;
  std::vector<double> sum_of(std::span<const ReceivedSurfel> surfels, std::uint8_t beyond, int threads) const;

  double start_, width_, length_;   // of the gate, of a cell
  double size_;                     // of a cell, in range resolutions and widths of shares
  std::size_t positions_, ranges_;  // numbers of cells
  // Energy of the cells for each value of ReceivedSurfel::beyond, ranges of one u after those of the u before; empty
  // if no surfel has the value.
  std::array<std::vector<double>, 4> energy_;
};

}  // namespace insonify
