// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "acoustics/direct_echoes.hpp"
#include "beamforming/display/cell_echoes_internal.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t echoes_at_once = 4096, cells_at_once = 16;
constexpr std::uint64_t other_seed = 0x9e3779b97f4a7c15;  // the golden ratio: far from the seeds of other pings
constexpr double spread_of_disc = 0.866;  // half width of the box with the variance of a disc, in its radius
constexpr double half_maximum_of_box =
    0.68;                              // length at half maximum of a Gaussian, in that of the box of its variance
constexpr double pieces_per_cell = 8;  // SamplingOptions::scatterers_per_cell

/// Part of a normal law below so many deviations, within 3e-6; 0 or 1 beyond reach_of_pulse.
double below_deviations(double away) {
  constexpr std::size_t entries = 1025;
  constexpr double step = 2 * reach_of_pulse / (entries - 1);
  static const std::vector<double> table = [] {
    std::vector<double> below;
    for (std::size_t k = 0; k < entries; ++k)
      below.push_back(0.5 * std::erfc((reach_of_pulse - static_cast<double>(k) * step) / std::numbers::sqrt2));
    below.front() = 0, below.back() = 1;
    return below;
  }();
  if (!(away > -reach_of_pulse)) return 0;
  if (!(away < reach_of_pulse)) return 1;
  const double place = (away + reach_of_pulse) / step;
  const auto left = std::min(static_cast<std::size_t>(place), entries - 2);
  return table[left] + (place - static_cast<double>(left)) * (table[left + 1] - table[left]);
}

/// Part of an echo's energy between two ranges: its surface is a box, and so is the pulse with it where the surface is
/// deeper than the pulse; else both are a normal law.
double part_between(const CellEcho& echo, double sigma, double low, double high) {
  if (echo.half_depth > sigma) {
    const double half = std::sqrt(echo.half_depth * echo.half_depth + 3 * sigma * sigma);
    return overlap(echo.range - half, echo.range + half, low, high) / (2 * half);
  }
  const double per_deviation = 1 / std::sqrt(sigma * sigma + echo.half_depth * echo.half_depth / 3);
  return below_deviations((high - echo.range) * per_deviation) - below_deviations((low - echo.range) * per_deviation);
}

/// First and last cell of an echo; the first is beyond the last if it has none.
struct CellSpan {
  std::uint32_t first = 1, last = 0;
};

/// Makes echoes of cells, some at a time.
class EchoMaker {
 public:
  EchoMaker(const DisplayPlan& plan, const SurfaceEchoes& surface, const Echoes& fixed, const Medium& medium,
            const CellOptions& options)
      : plan_(plan), surface_(surface), fixed_(fixed), options_(options), metres_per_s_(0.5 * medium.sound_speed) {}

  /// Sets the cells that echoes begin .. end - 1 are in.
  void find_cells(std::size_t begin, std::size_t end, std::vector<CellSpan>& cells) const {
    const std::size_t surfaces = surface_.id.size();
    for (std::size_t i = begin; i < end; ++i) {
      const bool is_surface = i < surfaces;
      const double depth = is_surface && surface_.power[i] > 0 ? static_cast<double>(surface_.depth[i]) : 0;
      cells[i] = cells_of(metres_per_s_ * (is_surface ? surface_.echoes.delay[i] : fixed_.delay[i - surfaces]), depth);
    }
  }
  /// Sets those of echoes begin .. end - 1 that have a place in the list; `place` beyond it: none.
  void make(std::size_t begin, std::size_t end, const std::vector<std::uint32_t>& place,
            std::vector<CellEcho>& echoes) const {
    const std::size_t surfaces = surface_.id.size();
    for (std::size_t i = begin; i < end; ++i)
      if (place[i] < echoes.size()) echoes[place[i]] = i < surfaces ? of_surface(i) : of_target(i - surfaces);
    if (!options_.speckle || begin >= surfaces) return;
    end = std::min(end, surfaces);
    std::vector<double> re(end - begin), im(end - begin);
    for (const std::size_t q : {0, 1}) {
      // The first is that of samples of the same seed (E9).
      random_amplitudes(options_.seed + q * other_seed, {surface_.id.data() + begin, end - begin}, re.data(),
                        im.data());
      for (std::size_t k = 0; k < re.size(); ++k)
        if (place[begin + k] < echoes.size() && !is_both(begin + k))
          echoes[place[begin + k]].amplitude[q] = {re[k], im[k]};
    }
  }

 private:
  CellEcho of_surface(std::size_t i) const {
    CellEcho echo = at(surface_.echoes, i);
    const double in_cell = energy_in_cell(echo.range);
    echo.energy = in_cell * surface_.power[i];
    if (echo.energy > 0) {
      echo.half_depth = static_cast<double>(surface_.depth[i]);
      echo.half_width = surface_.width[i];
      echo.pieces = pieces_of(echo.range, i);
      echo.together = together(i);
    }
    place(echo);
    return echo;
  }
  CellEcho of_target(std::size_t i) const {
    CellEcho echo = at(fixed_, i);
    echo.energy = echo.strength;
    echo.fixed = true;
    echo.amplitude = {1, 0};
    place(echo);
    return echo;
  }
  CellEcho at(const Echoes& echoes, std::size_t i) const {
    CellEcho echo;
    echo.range = metres_per_s_ * echoes.delay[i];
    echo.u = echoes.u[i];
    const double square = std::norm(echoes.amplitude[i]);
    echo.strength = energy_in_cell(echo.range) * square;
    if (square > 0) echo.phase = echoes.amplitude[i] / std::sqrt(square);
    return echo;
  }
  /// Energy of an echo of power 1 in a cell that holds all of it.
  double energy_in_cell(double range) const { return plan_.pulse.energy(range) / plan_.cell_length; }

  void place(CellEcho& echo) const {
    echo.reach = std::sqrt(echo.half_depth * echo.half_depth + plan_.pulse.half_length() * plan_.pulse.half_length());
    echo.node = static_cast<std::uint32_t>(plan_.node_of(echo.u));
    echo.port = static_cast<std::uint32_t>(plan_.node_of(echo.u + echo.half_width) / 2);
    echo.starboard = static_cast<std::uint32_t>(plan_.node_of(echo.u - echo.half_width) / 2);
  }

  /// Returns the number of parts that samples split a surface into (E17).
  double pieces_of(double range, std::size_t i) const {
    const double resolved = 2 * plan_.pulse.half_length() * half_maximum_of_box;
    const double radius = surface_.width[i] / spread_of_disc * range;
    const double sine = radius > 0 ? std::min(1.0, surface_.depth[i] / spread_of_disc / radius) : 1;
    const double length = std::min(resolved / std::max(sine, 1e-9), 2 * std::sqrt(2 * range * resolved));
    return std::max(1.0, pieces_per_cell * pi * radius * radius / (length * range * plan_.beam_width));
  }

  bool is_both(std::size_t i) const { return i < surface_.id.size() && surface_.id[i] == surface_.of_both; }

  /// Returns the energy of both senses of a path, in that of entry i; 1 of an echo that has no other sense.
  double together(std::size_t i) const {
    const std::size_t both = is_both(i) ? i : is_both(i + 1) ? i + 1 : i + 2;
    if (both < 2 || !is_both(both)) return 1;
    return (surface_.power[both - 2] + surface_.power[both - 1] + surface_.power[both]) / surface_.power[i];
  }

  CellSpan cells_of(double range, double half_depth) const {
    const auto last_cell = static_cast<double>(plan_.cells - 1);
    const double reach = half_depth + reach_of_pulse * plan_.pulse.deviation();
    const double low = std::floor((range - reach - plan_.first_range) / plan_.cell_length),
                 high = std::floor((range + reach - plan_.first_range) / plan_.cell_length);
    if (!(high >= 0 && low <= last_cell)) return {};
    return {static_cast<std::uint32_t>(std::max(low, 0.0)), static_cast<std::uint32_t>(std::min(high, last_cell))};
  }

  const DisplayPlan& plan_;
  const SurfaceEchoes& surface_;
  const Echoes& fixed_;
  const CellOptions& options_;
  double metres_per_s_;
};

/// Returns the place of each echo among those that are in a cell, by their first cells: what a cell holds stands side by
/// side. Those in no cell stand beyond. source: gets the echo at each place.
std::vector<std::uint32_t> places_by_cell(const std::vector<CellSpan>& cells, std::size_t count,
                                          std::vector<std::uint32_t>& source) {
  std::vector<std::uint32_t> first(count + 1, 0), place(cells.size(), std::numeric_limits<std::uint32_t>::max());
  for (const CellSpan& span : cells)
    if (span.first <= span.last) ++first[span.first + 1];
  for (std::size_t c = 0; c < count; ++c) first[c + 1] += first[c];
  source.resize(first[count]);
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    if (cells[i].first > cells[i].last) continue;
    place[i] = first[cells[i].first]++;
    source[place[i]] = i;
  }
  return place;
}

/// Sets the parts of the energies in cells begin .. end - 1.
void set_parts(const DisplayPlan& plan, std::size_t begin, std::size_t end, EchoesByCell& lists) {
  const double half = plan.pulse.half_length(), deviation = plan.pulse.deviation();
  for (std::size_t cell = begin; cell < end; ++cell) {
    const double first = plan.first_range + static_cast<double>(cell) * plan.cell_length,
                 last = first + plan.cell_length, middle = 0.5 * (first + last);
    for (std::size_t k = lists.first[cell]; k < lists.first[cell + 1]; ++k) {
      EchoInCell& in = lists.part[k];
      const CellEcho& echo = lists.echoes[in.echo];
      // The mean is over area, which grows with range.
      const double weight = std::clamp(echo.range, first, last) / middle;
      in.energy = echo.energy > 0 ? echo.energy * (weight * part_between(echo, deviation, first, last)) : 0;
      in.field = echo.strength * (weight * overlap(echo.range - half, echo.range + half, first, last) / (2 * half));
    }
  }
}

}  // namespace

EchoesByCell echoes_by_cell(const DisplayPlan& plan, const SurfaceEchoes& surface, const Echoes& fixed,
                            const Medium& medium, const CellOptions& options) {
  EchoesByCell lists;
  const std::size_t count = surface.id.size() + fixed.size();
  std::vector<CellSpan> cells(count);
  const EchoMaker maker(plan, surface, fixed, medium, options);
  parallel_blocks(count, echoes_at_once, options.threads,
                  [&](std::size_t begin, std::size_t end) { maker.find_cells(begin, end, cells); });
  const std::vector<std::uint32_t> place = places_by_cell(cells, plan.cells, lists.source);
  lists.echoes.resize(lists.source.size());
  parallel_blocks(count, echoes_at_once, options.threads,
                  [&](std::size_t begin, std::size_t end) { maker.make(begin, end, place, lists.echoes); });
  // The echoes of each cell, in the order in which they were given.
  lists.first.assign(plan.cells + 1, 0);
  for (const CellSpan& span : cells)
    for (std::size_t c = span.first; c <= span.last; ++c) ++lists.first[c + 1];
  for (std::size_t c = 0; c < plan.cells; ++c) lists.first[c + 1] += lists.first[c];
  lists.part.resize(lists.first.back());
  std::vector<std::size_t> next(lists.first.begin(), lists.first.end() - 1);
  for (std::uint32_t i = 0; i < count; ++i)
    for (std::size_t c = cells[i].first; c <= cells[i].last; ++c) lists.part[next[c]++].echo = place[i];
  parallel_blocks(plan.cells, cells_at_once, options.threads,
                  [&](std::size_t begin, std::size_t end) { set_parts(plan, begin, end, lists); });
  return lists;
}

RowWeights::RowWeights(const SonarHead& head, double wavelength, const std::vector<FanRow>& rows, double cutoff,
                       const SurfaceEchoes& surface, const Echoes& fixed, const std::vector<std::uint32_t>& source,
                       int threads)
    : head_(head), wavelength_(wavelength), threads_(threads) {
  const std::size_t surfaces = surface.id.size();
  for (const std::uint32_t i : source) v_.push_back(i < surfaces ? surface.echoes.v[i] : fixed.v[i - surfaces]);
  if (head.column) column_.emplace(*head.column, wavelength);
  std::vector<double> v_row;
  for (const FanRow& row : rows) v_row.push_back(std::sin(row.elevation));
  const auto nearest = [&](std::size_t i) -> double {
    std::size_t above = static_cast<std::size_t>(std::lower_bound(v_row.begin(), v_row.end(), v_[i]) - v_row.begin());
    if (above > 0 && (above == rows.size() || v_[i] - v_row[above - 1] < v_row[above] - v_[i])) --above;
    return rows[above].elevation;
  };
  least_.resize(v_.size());
  for_each(nearest, [&](std::size_t i, double response) { least_[i] = cutoff * std::abs(response); });
}

template <typename RowOf, typename Use>
void RowWeights::for_each(const RowOf& row_of, const Use& use) const {
  parallel_blocks(v_.size(), echoes_at_once, threads_, [&](std::size_t begin, std::size_t end) {
    double elevation = std::numeric_limits<double>::quiet_NaN(), v_row = 0;
    std::optional<RowResponse> row;
    for (std::size_t i = begin; i < end; ++i) {
      if (row_of(i) != elevation) {
        elevation = row_of(i), v_row = std::sin(elevation);
        if (!column_) row.emplace(head_, wavelength_, elevation);
      }
      use(i, column_ ? column_->amplitude(v_[i] - v_row) : row->at(v_[i]));
    }
  });
}

std::vector<double> RowWeights::of(const FanRow& row) const {
  std::vector<double> weights(v_.size());
  for_each([&](std::size_t) { return row.elevation; },
           [&](std::size_t i, double response) { weights[i] = std::abs(response) <= least_[i] ? 0 : response; });
  return weights;
}

}  // namespace insonify
