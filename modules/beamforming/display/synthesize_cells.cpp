// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/synthesize_cells.hpp"

#include <cmath>
#include <numeric>
#include <utility>

#include "beamforming/display/cell_echoes_internal.hpp"
#include "beamforming/display/cell_row_internal.hpp"
#include "beamforming/display/label_row_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/row_echoes_internal.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr const char* me = "synthesize_cells";
constexpr std::size_t blocks_of_thread = 8;  // blocks of pairs of cells for each thread, so that all end together
constexpr double row_tolerance = 1e-3;       // relative error by echoes that rows of beams omit

void require_valid(const SurfaceEchoes& surface) {
  const std::size_t n = surface.echoes.size();
  if (surface.id.size() != n || surface.power.size() != n || surface.depth.size() != n || surface.width.size() != n)
    fail(ErrorKind::argument, me, ": ", n, " delays, but ", surface.id.size(), " ids, ", surface.power.size(),
         " powers, ", surface.depth.size(), " depths and ", surface.width.size(), " widths");
}

/// Mean power of the noise at an element of a row [Pa^2], whose column is summed up first.
double noise_of_element(const SonarHead& head, const CellOptions& options) {
  if (std::isinf(options.element_noise_db)) return 0;
  const double noise = 2 * power_from_db(options.element_noise_db) * micropascal * micropascal;
  if (!head.column) return noise;
  const std::vector<double>& w = head.column->shading;
  return noise * std::inner_product(w.begin(), w.end(), w.begin(), 0.0) /
         std::pow(static_cast<double>(head.column->elements()), 2);  // (E56)
}

CellLabels no_labels(const SonarHead& head) {
  const auto beams = static_cast<Eigen::Index>(head.fan.beams()), cells = static_cast<Eigen::Index>(head.gate.bins());
  return {Grid<std::uint16_t>::Constant(beams, cells, CellLabels::none),
          Grid<std::uint16_t>::Constant(beams, cells, CellLabels::none), Grid<float>::Zero(beams, cells),
          Grid<float>::Zero(beams, cells), Grid<std::uint32_t>::Constant(beams, cells, CellLabels::no_echo)};
}

}  // namespace

struct CellSynthesizer::Plan {
  SonarHead head;
  Medium medium;
  std::vector<FanRow> rows;
  DisplayPlan display;
  std::vector<BeamPositions> beams{};  ///< places of the beams of each row

  Plan(const SonarHead& of, const Medium& water, double sample_length)
      : head(of), medium(water), rows(fan_rows(of.fan)), display(line_head(of, rows.front()), water, sample_length) {
    for (const FanRow& row : rows) beams.push_back(display.positions_of(line_head(head, row).fan));
  }
  bool one_line() const { return rows.size() == 1 && !head.column; }

  void form_row(const FanRow& of, const RowReception& reception, const EchoesByCell& lists, const CellOptions& options,
                Grid<double>& cells) const {
    // Each block also needs the pairs beside it, so that long ones do less work twice.
    const std::size_t pairs = (display.cells + 1) / 2;
    const std::size_t block = pairs / (blocks_of_thread * static_cast<std::size_t>(thread_count(options.threads)));
    parallel_blocks(pairs, std::clamp<std::size_t>(block, 8, 32), options.threads,
                    [&](std::size_t begin, std::size_t end) {
                      CellRow row(display, lists, reception, options);
                      for (std::size_t pair = begin; pair < end; ++pair) row.form(2 * pair, of.beams, cells);
                    });
  }
};

CellSynthesizer::CellSynthesizer(const SonarHead& head, const Medium& medium, double sample_length) {
  require_synthesis({}, head, medium, {}, me);
  if (!(sample_length >= 0 && std::isfinite(sample_length)))
    fail(ErrorKind::argument, me, ": sample_length = ", sample_length, " m, must be >= 0");
  if (!has_line(head)) require_one_row(head, me);
  plan_ = std::make_unique<const Plan>(head, medium, sample_length);
}
CellSynthesizer::~CellSynthesizer() = default;
CellSynthesizer::CellSynthesizer(CellSynthesizer&&) noexcept = default;

Grid<double> CellSynthesizer::cells(const SurfaceEchoes& surface, const Echoes& fixed,
                                    const CellOptions& options) const {
  return formed(surface, fixed, options, nullptr, nullptr);
}

Grid<double> CellSynthesizer::cells(const SurfaceEchoes& surface, const Echoes& fixed, const CellOptions& options,
                                    const EchoLabels& labels, CellLabels& shown) const {
  if (labels.label.size() > surface.id.size())
    fail(ErrorKind::argument, me, ": ", labels.label.size(), " labels, but ", surface.id.size(), " echoes");
  shown = no_labels(plan_->head);
  return formed(surface, fixed, options, &labels, &shown);
}

Grid<double> CellSynthesizer::formed(const SurfaceEchoes& surface, const Echoes& fixed, const CellOptions& options,
                                     const EchoLabels* labels, CellLabels* shown) const {
  const SonarHead& head = plan_->head;
  require_valid(surface);
  require_finite(surface.echoes, me);
  require_finite(fixed, me);
  const EchoesByCell lists = echoes_by_cell(plan_->display, surface, fixed, plan_->medium, options);
  Grid<double> cells(head.fan.beams(), head.gate.bins());
  RowReception reception;
  reception.element_noise = noise_of_element(head, options);
  std::optional<RowWeights> weights;
  if (!plan_->one_line()) {
    require_elevations(surface.echoes);
    require_elevations(fixed);
    weights.emplace(head, plan_->medium.sound_speed / head.pulse.centre_frequency, plan_->rows,
                    row_cutoff(row_tolerance, plan_->rows.size()), surface, fixed, lists.source, options.threads);
  }
  for (std::size_t r = 0; r < plan_->rows.size(); ++r) {
    reception.beams = plan_->beams[r];
    reception.first_element = r * head.array.elements();
    if (weights) reception.response = weights->of(plan_->rows[r]);
    std::optional<LabelledRow> labelled;
    if (labels)
      labelled.emplace(LabelledRow{{plan_->display, head, plan_->rows, r, reception.beams.u_beam},
                                   *labels,
                                   surface.echoes.v,
                                   plan_->rows[r].beams,
                                   *shown});
    reception.labelled = labelled ? &*labelled : nullptr;
    plan_->form_row(plan_->rows[r], reception, lists, options, cells);
  }
  return cells;  // (E180)
}

Grid<double> synthesize_cells(const SurfaceEchoes& surface, const Echoes& fixed, const SonarHead& head,
                              const Medium& medium, const CellOptions& options) {
  return CellSynthesizer(head, medium).cells(surface, fixed, options);
}

}  // namespace insonify
