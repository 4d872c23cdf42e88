// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/sampled_cells.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace insonify {
namespace {

constexpr double per_distance = 0.5;  // width of a cell in side lobes, in distances from the main lobe
// The share of the energy of a range, and of a range in a main lobe, from which a cell has all of its parts (E127).
constexpr double full_share_of_range = 0.125, full_share_of_lobe = 0.3;

/// Joins what lies within `half` of the axes.
std::vector<std::pair<double, double>> joined_lobes(std::vector<double> axes, double half) {
  std::sort(axes.begin(), axes.end());
  std::vector<std::pair<double, double>> joined;
  for (const double axis : axes)
    if (!joined.empty() && axis - half <= joined.back().second)
      joined.back().second = axis + half;
    else
      joined.emplace_back(axis - half, axis + half);
  return joined;
}

/// Distance of `position` from the nearest of the intervals; 0 inside.
double distance_from(const std::vector<std::pair<double, double>>& intervals, double position) {
  const auto after = std::partition_point(intervals.begin(), intervals.end(),
                                          [position](const auto& interval) { return interval.first <= position; });
  double distance = after == intervals.end() ? HUGE_VAL : after->first - position;
  if (after != intervals.begin()) distance = std::min(distance, position - std::prev(after)->second);
  return std::max(0.0, distance);
}

}  // namespace

SampledCells::SampledCells(const BeamFan& fan, const RangeGate& gate, const SamplingOptions& options)
    : scatterers_per_cell_(options.scatterers_per_cell),
      range_resolution_(options.range_resolution > 0 ? options.range_resolution : 2 * gate.bin_size),
      main_lobe_{fan.beam_width, fan.row_width},
      one_beam_(fan.beams() == 1) {
  std::vector<double> u, v;
  for (std::size_t b = 0; b < fan.beams(); ++b) {
    u.push_back(std::cos(fan.elevation[b]) * std::sin(fan.azimuth[b]));
    v.push_back(std::sin(fan.elevation[b]));
  }
  lobes_u_ = joined_lobes(std::move(u), main_lobe_reach * fan.beam_width + options.lobe_margin);
  if (fan.row_width > 0) lobes_v_ = joined_lobes(std::move(v), main_lobe_reach * fan.row_width + options.lobe_margin);
}

SampledCells::Widths SampledCells::widths(const Eigen::Vector3d& position, double reach) const {
  const double range = position.norm();
  if (!(range > reach)) return main_lobe_;
  const auto widened = [&](const Intervals& lobes, double along, double width) {
    return std::max(width, per_distance * (distance_from(lobes, along / range) - reach / range));  // (E17)
  };
  return {widened(lobes_u_, position.y(), main_lobe_.beam),
          lobes_v_.empty() ? 0 : widened(lobes_v_, position.z(), main_lobe_.row)};
}

double SampledCells::area(double range, double cos_incidence, const Widths& widths) const {
  const double sine = std::sqrt(std::max(0.0, 1 - cos_incidence * cos_incidence));
  const double dr = range_resolution_, level = 2 * std::sqrt(2 * range * dr);
  const double length = sine * level > dr ? dr / sine : level;
  double cell = length * range * widths.beam;
  if (widths.row > 0) {
    const double narrower = std::min(widths.beam, widths.row);
    const double cross_section = range * widths.beam * range * widths.row;
    cell = cross_section < cos_incidence * length * range * narrower ? cross_section / cos_incidence
                                                                     : length * range * narrower;
  }
  return cell;
}

double SampledCells::pieces(const Eigen::Vector3d& position, double surface, double cos_incidence) const {
  return pieces(position.norm(), surface, cos_incidence, widths(position, std::sqrt(surface / pi)));
}

double SampledCells::pieces(double range, double surface, double cos_incidence, const Widths& widths) const {
  if (!(scatterers_per_cell_ > 0)) return 1;
  return std::max(1.0, scatterers_per_cell_ * surface / area(range, cos_incidence, widths));  // (E17)
}

double SampledCells::pieces_of_share(double share, const Widths& widths) const {
  if (one_beam_) return scatterers_per_cell_ / full_share_of_range * share;                             // (E127)
  return widths.beam > main_lobe_.beam ? HUGE_VAL : scatterers_per_cell_ / full_share_of_lobe * share;  // (E127)
}

}  // namespace insonify
