// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

// Inner loops over raw pointers, compiled for several instruction sets and dispatched at run time, with the same bits
// on each. They do not include Eigen, so wide registers are safe.
namespace insonify::kernels {

/// Ranges of a cell whose energies are kept apart, at most, and numbers that are summed side by side.
constexpr std::size_t most_parts = 48, part_lanes = 16;

/// Returns the length of a row of so many ranges, in whole lanes.
constexpr std::size_t row_length(std::size_t parts) { return (parts + part_lanes - 1) / part_lanes * part_lanes; }

/// Energies in a cell: of node j of u and range n at j row_length(parts) + n, 0 for n >= parts; and the pattern of a
/// beam.
struct CellEnergies {
  const float* energy;
  std::size_t nodes, parts;
  const float* lobe;  ///< weight of nodes at distances 0, 1, .. below `lobe_reach`
  std::size_t lobe_reach;
  float beside, noise;       ///< weight of all nodes; energy that each range has besides
  const float* correlation;  ///< R_d of ranges d apart, d below `reach` (E182)
  std::size_t reach;
};
/// Sets looks[k] to (sum P)^2 / sum_kl P_k P_l R_|k-l| (E182) of a beam at node at[k], k < count; at least 1.
void count_looks(const CellEnergies& cell, const std::size_t* at, std::size_t count, double* looks);

}  // namespace insonify::kernels
