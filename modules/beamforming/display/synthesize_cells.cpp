// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/synthesize_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "acoustics/direct_echoes.hpp"
#include "beamforming/display/cell_row_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/row_echoes_internal.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr const char* me = "synthesize_cells";
constexpr std::size_t echoes_at_once = 4096;
constexpr std::uint64_t other_seed = 0x9e3779b97f4a7c15;  // the golden ratio: far from the seeds of other pings
constexpr double spread_of_disc = 0.866;  // half width of the box with the variance of a disc, in its radius
constexpr double half_maximum_of_box =
    0.68;                               // length at half maximum of a Gaussian, in that of the box of its variance
constexpr double pieces_per_cell = 8;   // SamplingOptions::scatterers_per_cell
constexpr double row_tolerance = 1e-3;  // of the echoes that rows of beams omit

/// Two random amplitudes of each echo. The first is the one that samples of the same seed have (E9).
using Amplitudes = std::vector<std::array<std::complex<double>, 2>>;

Amplitudes amplitudes_of(const SurfaceEchoes& surface, const CellOptions& options) {
  Amplitudes drawn(options.speckle ? surface.id.size() : 0);
  parallel_blocks(drawn.size(), echoes_at_once, options.threads, [&](std::size_t begin, std::size_t end) {
    std::vector<double> re(end - begin), im(end - begin);
    for (const std::size_t q : {0, 1}) {
      random_amplitudes(options.seed + q * other_seed, {surface.id.data() + begin, end - begin}, re.data(), im.data());
      for (std::size_t k = 0; k < re.size(); ++k) drawn[begin + k][q] = {re[k], im[k]};
    }
  });
  return drawn;
}

/// An echo of a row of beams: its index, surface echoes before fixed ones, and the row's response to it.
struct RowPart {
  std::uint32_t echo;
  double response;
};

/// Makes the cells of one row of beams after the other.
class CellImage {
 public:
  CellImage(const SurfaceEchoes& surface, const Echoes& fixed, const Medium& medium, const CellOptions& options)
      : surface_(surface),
        fixed_(fixed),
        options_(options),
        metres_per_s_(0.5 * medium.sound_speed),
        amplitude_(amplitudes_of(surface, options)) {}

  /// column: of a planar array, whose elements above each other add up to one element of a row
  Grid<double> of_row(const DisplayPlan& plan, const std::vector<RowPart>& parts, std::size_t first_element,
                      const std::optional<LineArray>& column = std::nullopt) const {
    const std::vector<CellEcho> echoes = cell_echoes(plan, parts);
    const EchoesByCell lists = lists_of(plan, echoes);
    double noise = std::isinf(options_.element_noise_db)
                       ? 0
                       : 2 * power_from_db(options_.element_noise_db) * micropascal * micropascal;
    if (column)
      noise *= std::inner_product(column->shading.begin(), column->shading.end(), column->shading.begin(), 0.0) /
               std::pow(static_cast<double>(column->elements()), 2);  // (E56)
    Grid<double> image(plan.u_beam.size(), plan.cells);
    parallel_blocks((plan.cells + 1) / 2, 4, options_.threads, [&](std::size_t begin, std::size_t end) {
      CellRow row(plan, echoes, lists, options_, noise, first_element);
      for (std::size_t pair = begin; pair < end; ++pair) row.form(2 * pair, image);
    });
    return image;
  }

 private:
  std::vector<CellEcho> cell_echoes(const DisplayPlan& plan, const std::vector<RowPart>& parts) const {
    std::vector<CellEcho> echoes(parts.size());
    parallel_blocks(parts.size(), echoes_at_once, options_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) echoes[k] = cell_echo(plan, parts[k]);
    });
    return echoes;
  }

  CellEcho cell_echo(const DisplayPlan& plan, const RowPart& part) const {
    const bool fixed = part.echo >= surface_.id.size();
    const std::size_t i = fixed ? part.echo - surface_.id.size() : part.echo;
    const Echoes& of = fixed ? fixed_ : surface_.echoes;
    CellEcho echo;
    echo.range = metres_per_s_ * of.delay[i];
    const double in_cell = part.response * std::sqrt(plan.pulse.energy(echo.range) / plan.cell_length);
    echo.u = of.u[i];
    echo.pressure = in_cell * of.amplitude[i];
    echo.energy = fixed ? std::norm(echo.pressure) : in_cell * in_cell * surface_.power[i];
    const bool spread = !fixed && echo.energy > 0;
    echo.half_depth = spread ? static_cast<double>(surface_.depth[i]) : 0;
    echo.half_width = spread ? surface_.width[i] : 0;
    echo.fixed = fixed;
    if (spread) echo.pieces = pieces_of(plan, echo.range, i);
    if (fixed)
      echo.amplitude = {1, 0};
    else if (options_.speckle)
      echo.amplitude = amplitude_[i];
    return echo;
  }

  /// Returns the number of parts that samples split a surface into (E17).
  double pieces_of(const DisplayPlan& plan, double range, std::size_t i) const {
    const double resolved = 2 * plan.pulse.half_length() * half_maximum_of_box;
    const double radius = surface_.width[i] / spread_of_disc * range;
    const double sine = radius > 0 ? std::min(1.0, surface_.depth[i] / spread_of_disc / radius) : 1;
    const double length = std::min(resolved / std::max(sine, 1e-9), 2 * std::sqrt(2 * range * resolved));
    return std::max(1.0, pieces_per_cell * pi * radius * radius / (length * range * plan.beam_width));
  }

  /// Lists the echoes of each cell, in their order.
  EchoesByCell lists_of(const DisplayPlan& plan, const std::vector<CellEcho>& echoes) const {
    const auto last_cell = static_cast<double>(plan.cells - 1);
    const auto cells_of = [&](const CellEcho& echo) -> std::optional<std::pair<std::size_t, std::size_t>> {
      const double reach = echo.half_depth + reach_of_pulse * plan.pulse.deviation();
      const double low = std::floor((echo.range - reach - plan.first_range) / plan.cell_length),
                   high = std::floor((echo.range + reach - plan.first_range) / plan.cell_length);
      if (!(high >= 0 && low <= last_cell)) return std::nullopt;
      return std::pair(static_cast<std::size_t>(std::max(low, 0.0)),
                       static_cast<std::size_t>(std::min(high, last_cell)));
    };
    EchoesByCell lists;
    lists.first.assign(plan.cells + 1, 0);
    for (const CellEcho& echo : echoes)
      if (const auto span = cells_of(echo))
        for (std::size_t c = span->first; c <= span->second; ++c) ++lists.first[c + 1];
    for (std::size_t c = 0; c < plan.cells; ++c) lists.first[c + 1] += lists.first[c];
    lists.echo.resize(lists.first.back());
    std::vector<std::size_t> next(lists.first.begin(), lists.first.end() - 1);
    for (std::uint32_t i = 0; i < echoes.size(); ++i)
      if (const auto span = cells_of(echoes[i]))
        for (std::size_t c = span->first; c <= span->second; ++c) lists.echo[next[c]++] = i;
    return lists;
  }

  const SurfaceEchoes& surface_;
  const Echoes& fixed_;
  const CellOptions& options_;
  double metres_per_s_;
  Amplitudes amplitude_;
};

void require_valid(const SurfaceEchoes& surface) {
  const std::size_t n = surface.echoes.size();
  if (surface.id.size() != n || surface.power.size() != n || surface.depth.size() != n || surface.width.size() != n)
    fail(ErrorKind::argument, me, ": ", n, " delays, but ", surface.id.size(), " ids, ", surface.power.size(),
         " powers, ", surface.depth.size(), " depths and ", surface.width.size(), " widths");
}

/// Surface echoes and fixed echoes in one list, from which the echoes of each row are taken.
Echoes joined(const SurfaceEchoes& surface, const Echoes& fixed) {
  Echoes all{surface.echoes.delay, surface.echoes.u, surface.echoes.amplitude, surface.echoes.v};
  all.delay.insert(all.delay.end(), fixed.delay.begin(), fixed.delay.end());
  all.u.insert(all.u.end(), fixed.u.begin(), fixed.u.end());
  all.v.insert(all.v.end(), fixed.v.begin(), fixed.v.end());
  all.amplitude.insert(all.amplitude.end(), fixed.amplitude.begin(), fixed.amplitude.end());
  return all;
}

}  // namespace

Grid<double> synthesize_cells(const SurfaceEchoes& surface, const Echoes& fixed, const SonarHead& head,
                              const Medium& medium, const CellOptions& options) {
  require_valid(surface);
  require_synthesis(surface.echoes, head, medium, {}, me);
  require_synthesis(fixed, head, medium, {}, me);
  const CellImage image(surface, fixed, medium, options);
  const std::vector<FanRow> rows = fan_rows(head.fan);
  if (rows.size() == 1 && !head.column) {
    std::vector<RowPart> all(surface.id.size() + fixed.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = {i, 1};
    return image.of_row(DisplayPlan(head, medium), all, 0);
  }
  const Echoes all = joined(surface, fixed);
  require_elevations(all);
  const RowEchoes row_echoes(all, head, medium.sound_speed / head.pulse.centre_frequency, rows,
                             row_cutoff(row_tolerance, rows.size()), options.threads);
  Grid<double> cells(head.fan.beams(), head.gate.bins());
  DisplayPlan plan(line_head(head, rows.front()), medium);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::vector<RowPart> parts;
    row_echoes.for_each_of(rows[r], [&](std::size_t i, double response) {
      parts.push_back({static_cast<std::uint32_t>(i), response});
    });
    plan.place_beams(line_head(head, rows[r]).fan);
    const Grid<double> beams = image.of_row(plan, parts, r * head.array.elements(), head.column);
    for (std::size_t k = 0; k < rows[r].beams.size(); ++k)
      cells.row(static_cast<Eigen::Index>(rows[r].beams[k])) = beams.row(static_cast<Eigen::Index>(k));
  }
  return cells;  // (E180)
}

}  // namespace insonify
