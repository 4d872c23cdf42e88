// SPDX-License-Identifier: BSD-3-Clause
// Echoes of a display cell that are added as pressures (E184).
#include <algorithm>
#include <cmath>

#include "beamforming/display/cell_row_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr double strong_part = 0.1;  // of a cell, from which on an echo is added as a pressure (E184)

}  // namespace

void CellRow::part_strong(Side& side) {
  const auto strong = [&](const Part& part) {
    const double energy = part.energy * part.echo->together / part.echo->pieces;
    if (part.echo->fixed || energy > strong_part * side.energy) return true;
    const std::int32_t beam = beams_.beam_near[part.echo->node];
    return beam >= 0 && energy > strong_part * side.mean[static_cast<std::size_t>(beam)];
  };
  const auto first = std::stable_partition(side.even.begin(), side.even.end(), [&](auto& p) { return !strong(p); });
  side.strong.assign(first, side.even.end());
  side.even.erase(first, side.even.end());
}

void CellRow::sum_strong(Side& side) {
  side.groups = 0;
  if (side.strong.empty()) return;
  // Echoes within a pulse of each other add up as pressures, others as intensities.
  std::stable_sort(side.strong.begin(), side.strong.end(),
                   [](const Part& a, const Part& b) { return a.echo->range < b.echo->range; });
  std::vector<Complex>& elements = nodes_[0];
  for (auto first = side.strong.begin(); first != side.strong.end();) {
    const double last = first->echo->range + 2 * plan_.pulse.half_length();
    std::fill(elements.begin(), elements.end(), Complex(0));
    for (; first != side.strong.end() && first->echo->range < last; ++first) add_strong(*first, elements, side.mean);
    if (side.groups == side.strong_field.size()) side.strong_field.emplace_back(plan_.period_samples + guards);
    form_period(elements.data(), side.strong_field[side.groups++]);
  }
  for (double& mean : side.mean) mean = std::max(mean, row_.element_noise * plan_.lag[0]);
}

void CellRow::add_strong(const Part& part, std::vector<Complex>& elements, std::vector<double>& mean) const {
  const CellEcho& echo = *part.echo;
  const double step = 2 * pi / (plan_.node_width * static_cast<double>(plan_.period));
  const double away = echo.u - (0.5 * plan_.node_width - 1);  // from node 0, where samples begin
  const std::size_t count = plan_.shading.size();
  const Complex turn = std::polar(1.0, -step * away);
  Complex at = part.sign * std::sqrt(part.energy) * echo.phase * echo.amplitude[0] *
               std::polar(1.0, -step * away * element_place(0, count));
  for (std::size_t m = 0; m < count; ++m, at *= turn) elements[(plan_.first_element + m) % plan_.period] += at;
  // The mean of even ground excludes it.
  for (std::size_t b = 0; b < mean.size(); ++b)
    mean[b] -= part.energy * plan_.response.intensity(echo.u - beams_.u_beam[b]);
}

}  // namespace insonify
