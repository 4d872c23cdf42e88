// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "beamforming/display/label_row_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

double half_of_widest_step(std::vector<double> positions) {
  std::sort(positions.begin(), positions.end());
  double widest = 0;
  for (std::size_t i = 1; i < positions.size(); ++i) widest = std::max(widest, positions[i] - positions[i - 1]);
  return 0.5 * widest;
}

/// Half extents in u or elevation: of a cell, which is as wide as the pattern at half its power and as the step to the
/// next one, and of the main lobe.
struct Extents {
  double cell, lobe;
};
Extents extents_of(double width, double half_step) {
  return {std::max(0.5 * width, half_step), std::max(width, half_step)};
}

/// Elevations within `half` of a row.
LabelLobes::Heights heights_about(double elevation, double half) {
  return {elevation - half < -pi / 2 ? -2 : std::sin(elevation - half),
          elevation + half > pi / 2 ? 2 : std::sin(elevation + half)};
}

}  // namespace

LabelLobes::LabelLobes(const DisplayPlan& plan, const SonarHead& head, const std::vector<FanRow>& rows, std::size_t row,
                       const std::vector<double>& u_beam) {
  const BeamFan& fan = head.fan;
  const Extents across = extents_of(fan.beam_width, half_of_widest_step(u_beam));
  const double width = plan.node_width;
  for (const double u : u_beam) {
    const std::size_t first = plan.node_of(u - across.lobe), last = plan.node_of(u + across.lobe);
    of_beam.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last - first + 1), lobe.size()});
    for (std::size_t node = first; node <= last; ++node) {
      const double low = static_cast<double>(node) * width - 1 - u, high = low + width;
      const auto response = [&](double at) { return plan.response.intensity(std::clamp(at, -2.0, 2.0)); };
      const double mean = (response(low) + 4 * response(0.5 * (low + high)) + response(high)) / 6;
      const auto within = [&](double half) { return mean * overlap(low, high, -half, half) / width; };
      lobe.push_back(static_cast<float>(within(across.lobe))), cell.push_back(static_cast<float>(within(across.cell)));
    }
  }
  const double width_up = fan.row_width > 0 ? fan.row_width : rows.size() > 1 ? fan.elevation_width : 0;
  if (width_up == 0) return;  // one row receives all elevations
  std::vector<double> elevations;
  for (const FanRow& each : rows) elevations.push_back(each.elevation);
  const Extents up = extents_of(width_up, half_of_widest_step(elevations));
  lobe_heights = heights_about(rows[row].elevation, up.lobe);
  cell_heights = heights_about(rows[row].elevation, up.cell);
}

LabelRow::LabelRow(const DisplayPlan& plan, const EchoesByCell& lists, const LabelledRow& row)
    : plan_(plan), lists_(lists), row_(row) {}

void LabelRow::start(std::size_t cell) {
  cell_ = cell;
  for (std::size_t k = 0; k < used_; ++k) {
    Sums& sums = sums_[k];
    for (std::vector<float>* energies : {&sums.lobe, &sums.cell, &sums.strongest})
      std::fill(energies->begin() + static_cast<std::ptrdiff_t>(sums.first),
                energies->begin() + static_cast<std::ptrdiff_t>(sums.last + 1), 0.f);
    sums.first = std::numeric_limits<std::size_t>::max(), sums.last = 0;
    sums_at_[sums.label] = 0;
  }
  used_ = 0;
}

LabelRow::Sums& LabelRow::sums_of(std::uint16_t label) {
  if (label >= sums_at_.size()) sums_at_.resize(label + std::size_t{1}, 0);
  if (sums_at_[label] == 0) {
    if (used_ == sums_.size()) {
      Sums& made = sums_.emplace_back();
      for (std::vector<float>* energies : {&made.lobe, &made.cell, &made.strongest}) energies->resize(plan_.nodes);
      made.by.resize(plan_.nodes);
    }
    sums_[used_].label = label;
    sums_at_[label] = ++used_;
  }
  return sums_[sums_at_[label] - 1];
}

void LabelRow::add(const CellEcho& echo, double energy) {
  const std::size_t i = index_of(echo);
  if (i >= row_.echoes.label.size() || !(energy > 0)) return;
  const LabelLobes& lobes = row_.lobes;
  const double sine = row_.sines.empty() ? 0 : row_.sines[i];
  if (sine < lobes.lobe_heights.low || sine > lobes.lobe_heights.high) return;
  const double middle = plan_.first_range + (static_cast<double>(cell_) + 0.5) * plan_.cell_length;
  const bool in_cell = std::abs(echo.range - middle) <= 0.5 * plan_.cell_length + echo.reach &&
                       sine >= lobes.cell_heights.low - echo.half_width &&
                       sine <= lobes.cell_heights.high + echo.half_width;
  Sums& sums = sums_of(row_.echoes.label[i]);
  const double half_width = echo.half_width, half = std::max(half_width, 0.5 * plan_.node_width) / plan_.node_width;
  const double position = (echo.u + 1) / plan_.node_width, last_node = static_cast<double>(plan_.nodes - 1);
  const double low = position - half, high = position + half, density = energy / (high - low);
  const auto first = static_cast<std::size_t>(std::clamp(low, 0.0, last_node)),
             last = static_cast<std::size_t>(std::clamp(high, 0.0, last_node));
  sums.first = std::min(sums.first, first), sums.last = std::max(sums.last, last);
  for (std::size_t node = first; node <= last; ++node) {
    const double at = static_cast<double>(node);
    const auto here = static_cast<float>(density * overlap(low, high, at, at + 1));
    sums.lobe[node] += here;
    if (!in_cell) continue;
    sums.cell[node] += here;
    if (here > sums.strongest[node]) sums.strongest[node] = here, sums.by[node] = static_cast<std::uint32_t>(i);
  }
}

LabelRow::Received LabelRow::received_from(const Sums& sums, const LabelLobes::Lobe& lobe) const {
  Received received{&sums};
  const std::size_t end = std::min<std::size_t>(lobe.first + lobe.count, sums.last + 1);
  for (std::size_t node = std::max<std::size_t>(lobe.first, sums.first); node < end; ++node) {
    const std::size_t k = lobe.at + node - lobe.first;
    received.lobe += row_.lobes.lobe[k] * sums.lobe[node];
    received.cell += row_.lobes.cell[k] * sums.cell[node];
  }
  return received;
}

std::uint32_t LabelRow::strongest_of(const Sums& sums, const LabelLobes::Lobe& lobe) const {
  std::uint32_t strongest = CellLabels::no_echo;
  float most = 0;
  const std::size_t end = std::min<std::size_t>(lobe.first + lobe.count, sums.last + 1);
  for (std::size_t node = std::max<std::size_t>(lobe.first, sums.first); node < end; ++node) {
    const float energy = row_.lobes.cell[lobe.at + node - lobe.first] * sums.strongest[node];
    if (energy > most) most = energy, strongest = sums.by[node];
  }
  return strongest;
}

void LabelRow::label_beam(std::size_t beam, double all) {
  const LabelLobes::Lobe& lobe = row_.lobes.of_beam[beam];
  Received best, second;
  for (std::size_t k = 0; k < used_; ++k) {
    const Received received = received_from(sums_[k], lobe);
    if (received.cell > best.cell) best = received;  // (E194)
  }
  if (!best.of) return;
  for (std::size_t k = 0; k < used_ && used_ > 1; ++k) {
    if (&sums_[k] == best.of) continue;
    const Received received = received_from(sums_[k], lobe);
    if (received.lobe > second.lobe) second = received;
  }
  const auto share_of = [all](const Received& received) {
    return all > 0 ? static_cast<float>(std::min(1.0, static_cast<double>(received.lobe) / all)) : 0.f;  // (E195)
  };
  const auto row = static_cast<Eigen::Index>(row_.beams[beam]), column = static_cast<Eigen::Index>(cell_);
  CellLabels& to = row_.labels;
  to.label(row, column) = best.of->label, to.share(row, column) = share_of(best);
  to.echo(row, column) = strongest_of(*best.of, lobe);
  if (second.of) to.second(row, column) = second.of->label, to.second_share(row, column) = share_of(second);
}

void LabelRow::finish(const std::vector<double>& mean, double noise) {
  if (used_ == 0) return;
  for (std::size_t b = 0; b < mean.size(); ++b) label_beam(b, mean[b] - noise);
}

}  // namespace insonify
