// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

// Inner loops over raw pointers, compiled for several instruction sets and dispatched at run time, with the same bits
// on each. They do not include Eigen, so wide registers are safe.
namespace insonify::kernels {

/// Ranges of a cell whose energies are kept apart, at most, and numbers that are summed side by side.
constexpr std::size_t most_subranges = 32, subrange_lanes = 16;

/// Returns the length of a row of so many ranges, in whole lanes.
constexpr std::size_t row_length(std::size_t subranges) {
  return (subranges + subrange_lanes - 1) / subrange_lanes * subrange_lanes;
}

/// Largest number of parts of the band whose energies are kept apart (E226).
constexpr std::size_t most_bands = 4 * subrange_lanes;

/// Grating lobes, as in GratingBands, and the energies of nodes over all ranges of a cell, with row_length(count) zeros
/// before the first node and behind the last.
struct GratingLobes {
  std::size_t first, count, bands;
  const float *heard, *all, *reversed, *with_band, *alike;
  std::size_t alike_reach;
  const float* whole;
};

/// Energies in a cell: of range n by how much more node j of u has than the one before, at j row_length(parts) + n, 0
/// for n >= parts; of all ranges alike, by how much more each of them has; and the pattern of a beam.
struct CellEnergies {
  float* energy;
  const float* alike;
  std::size_t nodes, subranges;
  const float* lobe;  ///< weight of nodes at distances 0, 1, .. below `lobe_reach`
  std::size_t lobe_reach;
  float beside, noise;       ///< weight of all nodes; noise that each range has besides
  float with_ground, alone;  ///< means of R of ground less that of noise with ground, and less that of noise (E223)
  const float* correlation;  ///< R_d of ranges d apart, d below `reach` (E182)
  std::size_t reach;
  const GratingLobes* gratings = nullptr;  ///< nullptr: none are heard
};
/// Energy of each node first .. end - 1 per range, from range `low` to `high` of a cell, whole or in part.
struct RangedEnergy {
  float low, high, density;
  std::uint32_t first, end;
};
/// Adds energies to those of the nodes, row_length(subranges) apart, by how much each node has more than the one
/// before.
void add_energies(const RangedEnergy* added, std::size_t count, std::size_t subranges, float* energy);

/// Sets looks[k] to (sum P)^2 / sum_kl P_k P_l R_|k-l| (E182, E223, E226) of a beam at node at[k], k < count; at least 1. Adds up
/// cell.energy over the nodes.
void count_looks(const CellEnergies& cell, const std::size_t* at, std::size_t count, double* looks);

/// Parts of a cell's ranges, each with a field of its own (E183).
constexpr std::size_t field_parts = 3;

/// Even ground in beams: the intensities of its fields and their expected powers, the expected product of each field with the
/// next, the number of looks that it shall have, the mean intensity, and the intensity of what stands out.
struct EvenGround {
  std::array<const double*, field_parts> intensity, power;
  std::array<const double*, field_parts - 1> shared;
  const double *looks, *mean, *strong;
};
/// Sets drawn[k] to strong[k] + mean[k] times a gamma variate of mean 1 with so many looks, k < count, from that which
/// the fields make (Wilson and Hilferty 1931; E183).
void draw_looks(const EvenGround& ground, std::size_t count, double* drawn);

}  // namespace insonify::kernels
