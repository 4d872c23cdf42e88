// SPDX-License-Identifier: BSD-3-Clause
// Looks of a display cell at the broad nodes that beams use (E182, E223, E226).
#include <algorithm>
#include <numeric>

#include "beamforming/display/cell_row_internal.hpp"
#include "beamforming/display/looks_loops_internal.hpp"

namespace insonify {

void CellRow::list_energies(std::size_t cell, const Side& side, double unit) {
  std::fill(energy_.begin(), energy_.end(), 0.f);
  std::fill(alike_.begin(), alike_.end(), 0.f);
  std::fill(whole_.begin(), whole_.end(), 0.f);
  ranged_.clear();
  float* const whole = whole_.empty() ? nullptr : whole_.data() + plan_.gratings.count;
  const double first = plan_.first_range + static_cast<double>(cell) * plan_.cell_length;
  const double per_length = static_cast<double>(plan_.subranges) / plan_.cell_length;
  const auto per_unit = static_cast<float>(1 / unit), length = static_cast<float>(plan_.subranges),
             ranges_per_metre = static_cast<float>(per_length);
  for (const Piece& piece : side.even) {
    const CellEcho& echo = *piece.echo;
    const float position = static_cast<float>((echo.range - first) * per_length), reach = echo.reach * ranges_per_metre;
    const float low = std::max(0.f, position - reach), high = std::min(length, position + reach);
    if (!(high > low)) continue;
    const std::uint32_t port = echo.port, starboard = echo.starboard;
    const float of_node = piece.energy * per_unit * echo.per_node;
    if (whole) whole[starboard] += of_node, whole[port + 1] -= of_node;
    const float density = of_node / (high - low);
    if (low == 0 && high == length) {
      alike_[starboard] += density, alike_[port + 1] -= density;
      continue;
    }
    ranged_.push_back({low, high, density, starboard, port + 1});
  }
  kernels::add_energies(ranged_.data(), ranged_.size(), plan_.subranges, energy_.data());
  if (!whole) return;
  std::partial_sum(whole, whole + plan_.broad, whole);
  whole[plan_.broad] = 0;
}

void CellRow::count_looks(std::size_t cell, Side& side) {
  // Energies by range, for broad nodes of u, each beyond those of the node before.
  const double unit = side.energy + side.noise;
  list_energies(cell, side, unit);
  kernels::CellEnergies of{energy_.data(),
                           alike_.data(),
                           plan_.broad,
                           plan_.subranges,
                           plan_.lobe.data(),
                           plan_.lobe.size(),
                           0,
                           0,
                           plan_.noise_with_ground,
                           plan_.noise_alone,
                           plan_.looks.data(),
                           plan_.looks.size()};
  of.beside = static_cast<float>(plan_.beside_lobe);
  of.noise = unit > 0 ? static_cast<float>(side.noise / unit / static_cast<double>(plan_.subranges)) : 0;
  const GratingBands& bands = plan_.gratings;
  const kernels::GratingLobes gratings{bands.first,
                                       bands.count,
                                       bands.bands,
                                       bands.heard.data(),
                                       bands.all.data(),
                                       bands.reversed.data(),
                                       bands.with_band.data(),
                                       bands.alike.data(),
                                       bands.alike.size(),
                                       whole_.data() + bands.count};
  if (bands.count > 0) of.gratings = &gratings;
  kernels::count_looks(of, beams_.broad_used.data(), beams_.broad_used.size(), side.looks.data());
}

}  // namespace insonify
