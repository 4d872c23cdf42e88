// SPDX-License-Identifier: BSD-3-Clause
#include "returns/cell_labels.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "core/units.hpp"
#include "returns/label_kinds_internal.hpp"
#include "sonar/beam_fan.hpp"

namespace insonify {
namespace {

constexpr float share_steps = 64, elevation_steps = 512;

/// First and last beam, by ascending u, and cell of a surfel in a row of beams.
struct CellBox {
  std::size_t row;
  Eigen::Index first_beam, last_beam, first_cell, last_cell;
};

/// The beams of a row by ascending direction cosine, found without a search.
class BeamsByCosine {
 public:
  BeamsByCosine(const BeamFan& fan, const FanRow& row) : elevation(row.elevation), start_(4 * row.beams.size() + 1) {
    for (const std::size_t beam : row.beams)
      by_u_.emplace_back(std::cos(fan.elevation[beam]) * std::sin(fan.azimuth[beam]), beam);
    std::sort(by_u_.begin(), by_u_.end());
    for (std::size_t k = 1; k < by_u_.size(); ++k) widest_step = std::max(widest_step, u(k) - u(k - 1));
    for (std::size_t b = 0; b < start_.size(); ++b)
      start_[b] = static_cast<std::size_t>(
          std::lower_bound(by_u_.begin(), by_u_.end(), std::pair(cosine_of(b), std::size_t{0})) - by_u_.begin());
  }
  double u(std::size_t k) const { return by_u_[k].first; }
  std::size_t beam(std::size_t k) const { return by_u_[k].second; }
  std::size_t size() const { return by_u_.size(); }
  /// Returns the first beam at or above a direction cosine; size() if there is none.
  std::size_t first_from(double cosine) const {
    const double position = (std::clamp(cosine, -1.0, 1.0) + 1) * 0.5 * static_cast<double>(start_.size() - 1);
    std::size_t k = start_[static_cast<std::size_t>(position)];
    while (k < by_u_.size() && u(k) < cosine) ++k;
    return k;
  }

  double elevation, widest_step = 0;

 private:
  double cosine_of(std::size_t bucket) const {
    return 2 * static_cast<double>(bucket) / static_cast<double>(start_.size() - 1) - 1 - 1e-12;
  }

  std::vector<std::pair<double, std::size_t>> by_u_;
  std::vector<std::size_t> start_;
};

/// Finds the cells that surfels reach into.
class CellFinder {
 public:
  CellFinder(const SonarHead& head, const Pose& world_from_head)
      : gate_(head.gate), head_from_world_(world_from_head.inverse()) {
    const BeamFan& fan = head.fan;
    double step = 0, step_up = 0;
    for (const FanRow& row : fan_rows(fan)) {
      rows_.emplace_back(fan, row);
      step = std::max(step, rows_.back().widest_step);
      if (rows_.size() > 1) step_up = std::max(step_up, row.elevation - rows_[rows_.size() - 2].elevation);
    }
    const bool sorts_heights = fan.row_width > 0 || rows_.size() > 1;
    half_u_ = 0.5 * std::max(fan.beam_width, step);
    half_up_ =
        sorts_heights ? 0.5 * std::max(fan.row_width > 0 ? fan.row_width : fan.elevation_width, step_up) : 2 * pi;
  }
  const std::vector<BeamsByCosine>& rows() const { return rows_; }

  /// Calls use(box) for each row of beams of which a surfel of the region reaches into cells.
  template <typename Use>
  void find(const SceneCloud& scene, std::size_t i, const SectorBounds& sector, double max_range,
            const Use& use) const {
    const Eigen::Vector3d p = head_from_world_ * (scene.origin + scene.point[i].cast<double>());
    const double range = std::max(p.norm(), 1e-9), radius = std::sqrt(static_cast<double>(scene.area[i]) / pi);
    if (range > max_range || !sector.holds(p)) return;
    const double across = half_u_ + radius / range, u = p.y() / range;
    const double first = std::max(0.0, std::floor((range - radius - gate_.min_range) / gate_.bin_size)),
                 last = std::min(static_cast<double>(gate_.bins()) - 1,
                                 std::floor((range + radius - gate_.min_range) / gate_.bin_size));
    if (last < first) return;
    const double up = rows_.size() > 1 || half_up_ < pi ? std::asin(std::clamp(p.z() / range, -1.0, 1.0)) : 0;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      if (half_up_ < pi && std::abs(up - rows_[r].elevation) > half_up_ + radius / range) continue;
      const std::size_t begin = rows_[r].first_from(u - across), end = rows_[r].first_from(u + across);
      if (begin < end)
        use(CellBox{r, static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - 1),
                    static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(last)});
    }
  }

 private:
  RangeGate gate_;
  Pose head_from_world_;
  std::vector<BeamsByCosine> rows_;
  double half_u_ = 0, half_up_ = 0;
};

/// Returns the boxes of the surfels of a region that a head does not see, block by block.
std::vector<std::vector<CellBox>> unseen_boxes(const PreparedScene& prepared, const InsonifiedRegion& region,
                                               const std::vector<std::uint8_t>& seen, const CellFinder& finder,
                                               int threads) {
  const SurfelMarks marks = prepared.marks_of(
      [&](const SurfelBlock& block) {
        return may_intersect(region, prepared.scene().origin + block.centre.cast<double>(), block.radius,
                             block.largest_area);
      },
      threads);
  constexpr std::size_t words = 512;
  const SectorBounds sector(region.sector);
  std::vector<std::vector<CellBox>> boxes((marks.words.size() + words - 1) / words);
  parallel_blocks(marks.words.size(), words, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<CellBox>& of_block = boxes[begin / words];
    marks.for_each(begin, end, [&](std::size_t i) {
      if (!seen[i])
        finder.find(prepared.scene(), i, sector, region.gate.max_range,
                    [&](const CellBox& box) { of_block.push_back(box); });
    });
  });
  return boxes;
}

}  // namespace

std::vector<std::uint16_t> label_numbers(const SceneCloud& scene, std::span<const std::uint32_t> surfels) {
  PixelLabels names;
  const LabelKinds kinds = name_kinds(scene, names);
  std::vector<std::uint16_t> numbers;
  numbers.reserve(surfels.size());
  for (const std::uint32_t surfel : surfels) numbers.push_back(static_cast<std::uint16_t>(kinds.of(scene, surfel)));
  return numbers;
}

PixelLabels labels_of_cells(const SceneCloud& scene, const CellLabels& cells, std::span<const std::uint32_t> surfels,
                            std::span<const double> sines) {
  const auto rounded = [](float value, float steps) { return std::round(value * steps) / steps; };
  const auto rounded_shares = [&](const Grid<float>& shares) {
    return shares.unaryExpr([&](float share) { return rounded(share, share_steps); }).eval();
  };
  PixelLabels labels{cells.label, {}, rounded_shares(cells.share), {}};
  name_kinds(scene, labels);
  const Eigen::Index beams = cells.label.rows(), count = cells.label.cols();
  labels.id = Grid<std::uint32_t>::Constant(beams, count, PixelLabels::no_id);
  if (!scene.part.empty()) labels.part = Grid<std::uint16_t>::Constant(beams, count, PixelLabels::no_part);
  labels.second = cells.second, labels.second_share = rounded_shares(cells.second_share);
  labels.elevation = Grid<float>::Zero(beams, count);
  for (Eigen::Index i = 0; i < cells.echo.size(); ++i) {
    const std::uint32_t echo = cells.echo(i);
    if (echo == CellLabels::no_echo) continue;
    labels.id(i) = scene.id[surfels[echo]];
    if (!scene.part.empty()) labels.part(i) = scene.part[surfels[echo]];
    const double sine = sines.empty() ? 0 : std::clamp(sines[echo], -1.0, 1.0);
    labels.elevation(i) = rounded(static_cast<float>(std::asin(sine)), elevation_steps);
  }
  return labels;
}

void mark_shadow(const PreparedScene& prepared, const InsonifiedRegion& region, const std::vector<std::uint8_t>& seen,
                 const SonarHead& head, int threads, PixelLabels& labels) {
  const CellFinder finder(head, region.world_from_head);
  const Eigen::Index cells = labels.material.cols();
  // Each box adds 1 at its corners; sums over beams and cells then count the boxes that hold a cell.
  std::vector<Grid<std::int32_t>> steps;
  for (const BeamsByCosine& row : finder.rows())
    steps.push_back(Grid<std::int32_t>::Zero(static_cast<Eigen::Index>(row.size()) + 1, cells + 1));
  for (const std::vector<CellBox>& boxes : unseen_boxes(prepared, region, seen, finder, threads))
    for (const auto& [row, first_beam, last_beam, first_cell, last_cell] : boxes) {
      Grid<std::int32_t>& of_row = steps[row];
      ++of_row(first_beam, first_cell), --of_row(first_beam, last_cell + 1);
      --of_row(last_beam + 1, first_cell), ++of_row(last_beam + 1, last_cell + 1);
    }
  for (std::size_t r = 0; r < steps.size(); ++r)
    for (Eigen::Index k = 0; k + 1 < steps[r].rows(); ++k) {
      if (k > 0) steps[r].row(k) += steps[r].row(k - 1);
      const auto beam = static_cast<Eigen::Index>(finder.rows()[r].beam(static_cast<std::size_t>(k)));
      std::int32_t count = 0;
      for (Eigen::Index cell = 0; cell < cells; ++cell) {
        count += steps[r](k, cell);
        std::uint16_t& label = labels.material(beam, cell);
        if (count > 0 && label == PixelLabels::nothing) label = PixelLabels::shadow;  // (E194)
      }
    }
}

}  // namespace insonify
