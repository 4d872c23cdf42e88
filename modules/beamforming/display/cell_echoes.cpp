// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "beamforming/display/cell_echoes_internal.hpp"
#include "beamforming/display/field_points_internal.hpp"
#include "core/parallel.hpp"
#include "core/positions_by_group.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t least_at_once = 8192;
constexpr std::uint32_t no_slot = std::numeric_limits<std::uint32_t>::max();

/// First and last cell of an echo; the first is beyond the last if it has none.
struct CellSpan {
  std::uint32_t first = 1, last = 0;
};

/// Makes echoes of cells, some at a time.
class EchoMaker {
 public:
  EchoMaker(const DisplayPlan& plan, const SurfaceEchoes& surface, const Echoes& fixed, const Medium& medium)
      : plan_(plan),
        surface_(surface),
        fixed_(fixed),
        metres_per_s_(0.5 * medium.sound_speed),
        per_cell_length_(1 / plan.cell_length) {
    for (std::size_t cell = 0; cell <= plan.cells; ++cell) {
      ranges_.push_back(plan.first_range + static_cast<double>(cell) * plan.cell_length);
      edges_.push_back(plan.edges.at(ranges_.back()));
    }
  }

  /// Returns the cells that echo i is in.
  CellSpan cells_of(std::size_t i) const {
    const std::size_t surfaces = surface_.id.size();
    const bool is_surface = i < surfaces;
    const double depth = is_surface && surface_.power[i] > 0 ? static_cast<double>(surface_.depth[i]) : 0;
    return cells_about(metres_per_s_ * (is_surface ? surface_.echoes.delay[i] : fixed_.delay[i - surfaces]), depth);
  }
  /// Returns true if an echo has the energy of a surface or target.
  bool has_energy(std::size_t i) const { return i >= surface_.id.size() || surface_.power[i] > 0; }
  /// Returns echo i, at the peak of the responses of rows; its random amplitude is not in its pressure yet.
  CellEcho make(std::size_t i) const {
    const std::size_t surfaces = surface_.id.size();
    return i < surfaces ? of_surface(i) : of_target(i - surfaces);
  }
  /// Calls use(cell, energy) for the energy of an echo in each of its cells.
  template <typename Use>
  void for_each_part(const CellEcho& echo, const CellSpan& cells, const Use& use) const {
    const double range = echo.range, depth = echo.half_depth, energy = echo.energy;
    const auto before = [&](std::size_t cell) {
      return energy > 0 ? plan_.edges.before(edges_[cell], range, depth) : 0;
    };
    double near = before(cells.first);
    for (std::size_t cell = cells.first; cell <= cells.last; ++cell) {
      const double far = before(cell + 1), first = ranges_[cell], last = ranges_[cell + 1];
      // The mean is over area, which grows with range.
      const double weight = std::clamp(range, first, last) * (2 / (first + last));
      use(cell, static_cast<float>(energy * (weight * (far - near))));  // (E227)
      near = far;
    }
  }

 private:
  using Complex = std::complex<double>;

  /// Returns an echo without energy, that is alone with its amplitude.
  static CellEcho nothing() {
    CellEcho echo{};
    echo.together = 1;
    return echo;
  }
  CellEcho of_surface(std::size_t i) const {
    CellEcho echo = nothing();
    const double in_cell = set_place(surface_.echoes, i, echo);
    echo.energy = static_cast<float>(in_cell * surface_.power[i]);
    if (echo.energy > 0) {
      echo.half_depth = surface_.depth[i];
      echo.half_width = echo.across = surface_.width[i];
      if (i < surface_.slope.size()) echo.slope = surface_.slope[i], echo.across = surface_.across[i];
      echo.together = together(i);
    }
    set_extent(surface_.echoes.u[i], echo);
    return echo;
  }
  CellEcho of_target(std::size_t i) const {
    CellEcho echo = nothing();
    const double in_cell = set_place(fixed_, i, echo);
    if (const double size = std::abs(fixed_.amplitude[i]); size > 0)
      echo.set_pressure(std::complex<float>(fixed_.amplitude[i] / size));
    echo.energy = static_cast<float>(in_cell * std::norm(fixed_.amplitude[i]));
    echo.together = 0;
    set_extent(fixed_.u[i], echo);
    return echo;
  }
  /// Sets range and direction; returns the energy of an echo of power 1 in a cell that holds all of it.
  double set_place(const Echoes& echoes, std::size_t i, CellEcho& echo) const {
    const double range = metres_per_s_ * echoes.delay[i];
    echo.range = static_cast<float>(range), echo.u = static_cast<float>(echoes.u[i]);
    return plan_.pulse.energy(range) * per_cell_length_;
  }
  void set_extent(double u, CellEcho& echo) const {
    const auto width = static_cast<double>(echo.half_width);
    echo.port = static_cast<std::uint32_t>(plan_.node_of(u + width) / 2);
    echo.starboard = static_cast<std::uint32_t>(plan_.node_of(u - width) / 2);
    echo.per_node = 1 / static_cast<float>(echo.port - echo.starboard + 1);
    const auto pulse = static_cast<float>(plan_.pulse.half_length());
    echo.reach = std::sqrt(echo.half_depth * echo.half_depth + pulse * pulse);
  }

  bool is_both(std::size_t i) const { return i < surface_.id.size() && surface_.id[i] == surface_.of_both; }

  /// Returns the energy of both senses of a path, in that of entry i; 1 of an echo that has no other sense.
  float together(std::size_t i) const {
    const std::size_t both = is_both(i) ? i : is_both(i + 1) ? i + 1 : i + 2;
    if (both < 2 || !is_both(both)) return 1;
    return static_cast<float>((surface_.power[both - 2] + surface_.power[both - 1] + surface_.power[both]) /
                              surface_.power[i]);
  }

  CellSpan cells_about(double range, double half_depth) const {
    const auto last_cell = static_cast<double>(plan_.cells - 1);
    const double reach = half_depth + plan_.edges.reach();
    const double low = std::floor((range - reach - plan_.first_range) * per_cell_length_),
                 high = std::floor((range + reach - plan_.first_range) * per_cell_length_);
    if (!(high >= 0 && low <= last_cell)) return {};
    return {static_cast<std::uint32_t>(std::max(low, 0.0)), static_cast<std::uint32_t>(std::min(high, last_cell))};
  }

  const DisplayPlan& plan_;
  const SurfaceEchoes& surface_;
  const Echoes& fixed_;
  double metres_per_s_, per_cell_length_;
  std::vector<double> ranges_;  // ranges of the edges of cells [m]
  std::vector<CellEdges::Edge> edges_;
};

/// Echoes of a ping, by blocks that threads take.
struct EchoBlocks {
  std::size_t at_once;          ///< echoes of a block
  std::vector<CellSpan> cells;  ///< cells of each echo
  ItemsOfBlocks echoes,
      pieces;  ///< numbers of echoes by their first cells, and of echoes with energy by all of their cells
};

/// Finds the cells of all echoes, and counts what is in each.
EchoBlocks count_blocks(const EchoMaker& maker, std::size_t count, std::size_t cells, int threads) {
  // Blocks are so large that their numbers of all cells are no more than echoes or cells.
  EchoBlocks blocks{std::max(least_at_once, cells), std::vector<CellSpan>(count), {}, {}};
  blocks.echoes.resize((count + blocks.at_once - 1) / blocks.at_once, std::vector<std::size_t>(cells));
  blocks.pieces = blocks.echoes;
  parallel_blocks(count, blocks.at_once, threads, [&](std::size_t begin, std::size_t end) {
    const std::size_t block = begin / blocks.at_once;
    for (std::size_t i = begin; i < end; ++i) {
      const CellSpan span = blocks.cells[i] = maker.cells_of(i);
      if (span.first > span.last) continue;
      ++blocks.echoes[block][span.first];
      if (!maker.has_energy(i)) continue;
      for (std::size_t c = span.first; c <= span.last; ++c) ++blocks.pieces[block][c];
    }
  });
  return blocks;
}

}  // namespace

EchoesByCell echoes_by_cell(const DisplayPlan& plan, const SurfaceEchoes& surface, const Echoes& fixed,
                            const Medium& medium, const CellOptions& options) {
  const std::size_t count = surface.id.size() + fixed.size();
  const EchoMaker maker(plan, surface, fixed, medium);
  EchoBlocks blocks = count_blocks(maker, count, plan.cells, options.threads);
  EchoesByCell lists;
  // Echoes stand by their first cells, so that a cell has its own side by side.
  const std::size_t listed = positions_by_group(blocks.echoes, plan.cells).back();
  lists.first = positions_by_group(blocks.pieces, plan.cells);
  lists.echoes.resize(listed), lists.source.resize(listed), lists.piece.resize(lists.first.back());
  UninitializedVector<std::uint32_t> slot(count);
  const FieldPointMaker point_maker(plan, surface, options);
  std::vector<DrawnPoints> points(blocks.echoes.size());
  parallel_blocks(count, blocks.at_once, options.threads, [&](std::size_t begin, std::size_t end) {
    const std::size_t block = begin / blocks.at_once;
    for (std::size_t i = begin; i < end; ++i) {
      const CellSpan span = blocks.cells[i];
      slot[i] = no_slot;
      if (span.first > span.last) continue;
      const auto at = static_cast<std::uint32_t>(blocks.echoes[block][span.first]++);
      slot[i] = at, lists.source[at] = static_cast<std::uint32_t>(i), lists.echoes[at] = maker.make(i);
      if (!maker.has_energy(i)) continue;
      maker.for_each_part(lists.echoes[at], span, [&](std::size_t cell, float energy) {
        lists.piece[blocks.pieces[block][cell]++] = {at, energy};
      });
    }
    points[block] = point_maker.draw(begin, std::min(end, surface.id.size()), slot, lists.echoes);
  });
  lists.points = point_maker.by_cell(points);
  return lists;
}

RowWeights::RowWeights(const SonarHead& head, double wavelength, const std::vector<FanRow>& rows, double cutoff,
                       const SurfaceEchoes& surface, const Echoes& fixed,
                       const UninitializedVector<std::uint32_t>& source, int threads)
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
  parallel_blocks(v_.size(), least_at_once, threads_, [&](std::size_t begin, std::size_t end) {
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
