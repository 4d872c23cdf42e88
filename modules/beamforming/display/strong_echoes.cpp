// SPDX-License-Identifier: BSD-3-Clause
// Echoes of a display cell that are added as pressures (E184).
#include <algorithm>
#include <cmath>

#include "beamforming/display/cell_row_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr double strong_share = 0.1;      // share of a cell above which an echo is a pressure (E184)
constexpr double spread_of_disc = 0.866;  // half width of the box with the variance of a disc, in its radius
constexpr double half_maximum_of_box =
    0.68;                              // length at half maximum of a Gaussian, in that of the box of its variance
constexpr double pieces_per_cell = 8;  // SamplingOptions::scatterers_per_cell

/// Returns the number of parts that samples split a surface into (E17).
double pieces_of(const CellEcho& echo, const DisplayPlan& plan) {
  if (!(echo.half_width > 0)) return 1;
  const double resolved = 2 * plan.pulse.half_length() * half_maximum_of_box, range = echo.range;
  const double radius = static_cast<double>(echo.half_width) / spread_of_disc * range;
  const double sine = radius > 0 ? std::min(1.0, static_cast<double>(echo.half_depth) / spread_of_disc / radius) : 1;
  const double length = std::min(resolved / std::max(sine, 1e-9), 2 * std::sqrt(2 * range * resolved));
  return std::max(1.0, pieces_per_cell * pi * radius * radius / (length * range * plan.beam_width));
}

}  // namespace

void CellRow::partition_strong(Side& side) {
  const auto strong = [&](const Piece& piece) {
    const CellEcho& echo = *piece.echo;
    if (echo.together == 0) return true;
    const double energy = piece.energy * echo.together;
    const std::int32_t beam = beams_.beam_near[plan_.node_of(echo.u)];
    const double reception = beam < 0 ? side.energy : std::min(side.energy, side.mean[static_cast<std::size_t>(beam)]);
    return energy > strong_share * reception && energy > strong_share * reception * pieces_of(echo, plan_);
  };
  const auto found = std::find_if(side.even.begin(), side.even.end(), strong);
  const auto first = std::stable_partition(found, side.even.end(), [&](auto& p) { return !strong(p); });
  side.strong.assign(first, side.even.end());
  side.even.erase(first, side.even.end());
  side.strong_numbers.clear();
  for (const Piece& piece : side.strong)
    if (piece.echo->together > 0)
      side.strong_numbers.push_back(static_cast<std::uint32_t>(piece.echo - lists_.echoes.data()));
  std::sort(side.strong_numbers.begin(), side.strong_numbers.end());
}

void CellRow::sum_strong(Side& side) {
  side.groups = 0;
  if (side.strong.empty()) return;
  // Echoes within a pulse of each other add up as pressures, others as intensities.
  std::stable_sort(side.strong.begin(), side.strong.end(),
                   [](const Piece& a, const Piece& b) { return a.echo->range < b.echo->range; });
  for (auto first = side.strong.begin(); first != side.strong.end();) {
    const double last = first->echo->range + 2 * plan_.pulse.half_length();
    std::fill(at_elements_.begin(), at_elements_.end(), 0);
    for (; first != side.strong.end() && first->echo->range < last; ++first) add_strong(*first, side.mean);
    if (side.groups == side.strong_field.size())
      side.strong_field.emplace_back(plan_.period + guards_before + guards_behind);
    form_field(side.strong_field[side.groups++]);
  }
  for (double& mean : side.mean) mean = std::max(mean, row_.element_noise * plan_.lag[0]);
}

void CellRow::add_strong(const Piece& piece, std::vector<double>& mean) {
  const CellEcho& echo = *piece.echo;
  const double step = 2 * pi / (plan_.node_width * static_cast<double>(plan_.period));
  const double u = echo.u, away = u - (0.5 * plan_.node_width - 1);  // from node 0, where samples begin
  const std::size_t count = plan_.lag.size();
  const Complex turn = std::polar(1.0, -step * away);
  Complex at = static_cast<double>(std::copysign(std::sqrt(piece.energy), piece.response)) * Complex(echo.pressure()) *
               std::polar(1.0, -step * away * element_position(0, count));
  for (std::size_t m = 0; m < count; ++m, at *= turn)
    at_elements_[(plan_.first_element + m) % plan_.period] += std::complex<float>(at);
  // The mean of even ground excludes it.
  for (std::size_t b = 0; b < mean.size(); ++b) mean[b] -= heard_of(piece, b);
}

}  // namespace insonify
