// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "beamforming/display/looks_loops_internal.hpp"
#include "core/target_clones.hpp"

namespace insonify::kernels {

INSONIFY_CLONES void count_looks(const CellEnergies& cell, const std::size_t* at, std::size_t count, double* looks) {
  const std::size_t whole = row_length(cell.parts);
  // Energies of all nodes, as side lobes hear them; of ranges beyond the cell nothing.
  float everywhere[most_parts] = {};
  for (std::size_t j = 0; j < cell.nodes; ++j)
    for (std::size_t n = 0; n < whole; ++n) everywhere[n] += cell.energy[j * whole + n];
  for (std::size_t n = 0; n < cell.parts; ++n) everywhere[n] = cell.noise + cell.beside * everywhere[n];

  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t j = at[k], reach = cell.lobe_reach - 1;
    float heard[2 * most_parts] = {};  // what lies beyond is 0
    for (std::size_t n = 0; n < whole; ++n) heard[n] = everywhere[n];
    for (std::size_t i = j > reach ? j - reach : 0; i <= std::min(j + reach, cell.nodes - 1); ++i) {
      const float weight = cell.lobe[i > j ? i - j : j - i];
      for (std::size_t n = 0; n < whole; ++n) heard[n] += weight * cell.energy[i * whole + n];
    }
    float sums[part_lanes] = {}, products[part_lanes] = {};
    for (std::size_t n = 0; n < whole; n += part_lanes)
      for (std::size_t l = 0; l < part_lanes; ++l) sums[l] += heard[n + l];
    for (std::size_t d = 0; d < cell.reach; ++d) {
      const float weight = (d > 0 ? 2 : 1) * cell.correlation[d];
      for (std::size_t n = 0; n < whole; n += part_lanes)
        for (std::size_t l = 0; l < part_lanes; ++l) products[l] += weight * heard[n + l] * heard[n + l + d];
    }
    float sum = 0, product = 0;
    for (std::size_t l = 0; l < part_lanes; ++l) sum += sums[l], product += products[l];
    looks[k] = product > 0 ? std::max(1.0, static_cast<double>(sum / product * sum)) : 1;  // (E182)
  }
}

}  // namespace insonify::kernels
