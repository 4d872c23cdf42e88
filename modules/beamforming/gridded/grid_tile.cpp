// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "beamforming/gridded/grid_tile_internal.hpp"

namespace insonify {
namespace {

using kernels::brick_columns;
using kernels::brick_stride;

constexpr std::size_t rows_at_a_time = 48;    // of beams that are formed together; a multiple of kernels::rows_at_once
constexpr std::size_t flush_interval = 2048;  // echoes added to a brick before its sums are flushed
constexpr double least_gain = 1e-130;         // of pulses that absorption leaves: squares of its inverse are numbers
static_assert(rows_at_a_time % kernels::rows_at_once == 0);

template <typename Real>
kernels::GaussianGrid gaussian_grid(const GriddingPlan<Real>& plan, std::size_t first_bin) {
  return {.start = plan.axis.start,
          .step = plan.axis.step,
          .half = plan.longest_half,
          .first_row = static_cast<double>(first_bin) - static_cast<double>(plan.margin),
          .first_u = 0,
          .cycles_per_u = plan.cycles_per_u,
          .grid = static_cast<double>(plan.grid),
          .half_width = 0.5 * static_cast<double>(plan.kernel.width()),
          .pad = static_cast<double>(grid_pad),
          .half_positions = plan.element_offset != 0};
}

}  // namespace

template <typename Real>
GridTile<Real>::GridTile(const GriddingPlan<Real>& plan)
    : plan_(plan),
      columns_(plan.column ? brick_columns : plan.stride),
      stride_(plan.column ? brick_stride : plan.stride),
      blocks_((plan.stride + columns_ - 1) / columns_),
      plane_(plan.tile_rows * stride_),
      brick_((plan.column ? plan.column->lines : 1) * blocks_, nullptr),
      of_block_(blocks_),
      scratch_(plan.sweep_re.pieces > 0 ? 2 * (plan.tile_bins + 16) : 0),
      re_(plan.column ? rows_at_a_time * plan.tile_bins * blocks_ * columns_ : 0),
      im_(plan.column ? rows_at_a_time * plan.tile_bins * blocks_ * columns_ : 0),
      grid_(plan.grid * plan.grid_row) {}

template <typename Real>
typename GridTile<Real>::Brick& GridTile<Real>::brick_at(std::size_t line, std::size_t block) {
  Brick*& brick = brick_[line * blocks_ + block];
  if (!brick) {
    if (used_ == room_.size()) room_.push_back(std::make_unique<Brick>(2 * plane_));
    brick = room_[used_++].get();
    brick->line = line;
    of_block_[block].push_back(brick);
  }
  return *brick;
}

template <typename Real>
typename GridTile<Real>::Brick& GridTile<Real>::flushed(Brick& brick) {
  if (brick.since_flush < flush_interval) return brick;
  brick.flushed.resize(2 * plane_, 0);
  for (std::size_t k = 0; k < 2 * plane_; ++k) brick.flushed[k] += brick.sum[k];
  std::ranges::fill(brick.sum, Real(0));
  brick.since_flush = 0;
  return brick;
}

template <typename Real>
bool GridTile<Real>::set_unit(const Echoes& echoes, List list) {
  double most = 0, first = std::numeric_limits<double>::infinity(), last = 0;
  for (const std::uint32_t i : list) {
    most = std::max(most, std::norm(echoes.amplitude[i]));
    first = std::min(first, echoes.delay[i]);
    last = std::max(last, echoes.delay[i]);
  }
  // The gain of a pulse is convex over its way, so it is largest at an end.
  const auto gain = [this](double delay) { return std::abs(plan_.shapes.of(std::max(delay, 0.0)).at(0)); };
  const double sent = std::sqrt(most), level = list.empty() ? 0 : sent * std::max(gain(first), gain(last));
  if (level == 0) return false;
  if (unit_ != 0 && level <= unit_ * 0x1p64) return true;
  clear();  // what is weaker by 2^64 does not count
  unit_ = std::exp2(std::round(std::log2(std::max(level, least_gain * sent))));
  return true;
}

template <typename Real>
void GridTile<Real>::add(const Echoes& echoes, const PulseReach& reach, List list, std::size_t first_bin) {
  if (!set_unit(echoes, list)) return;
  if (plan_.longest_rows > 0)
    add_gaussians(echoes, list, first_bin);
  else if (plan_.sweep_re.pieces > 0 && echoes.doppler.empty())
    add_planned_sweeps(echoes, list, first_bin);
  else
    add_sampled_sweeps(echoes, reach, list, first_bin);
}

template <typename Real>
void GridTile<Real>::add_gaussians(const Echoes& echoes, List list, std::size_t first_bin) {
  const kernels::GaussianGrid grid = gaussian_grid(plan_, first_bin);
  while (!list.empty()) {
    std::size_t count = std::min(GaussianBatch<Real>::most, list.size());
    if (!plan_.column) count = std::min(count, flush_interval - flushed(brick_at(0, 0)).since_flush);
    const List some = list.first(count);
    energy_ +=
        plan_.pulse_energy * pulses_.sample(grid, plan_.shapes, plan_.medium, echoes, some, unit_, plan_.longest_rows);
    if (plan_.column) {
      add_to_lines(echoes, some);
    } else {
      Brick& brick = brick_at(0, 0);
      kernels::grid_samples(pulses_.positions(), count, pulses_.re.data(), pulses_.im.data(), plan_.longest_rows,
                            plan_.columns, brick.sum.data(), brick.sum.data() + plane_, stride_);
      brick.since_flush += count;
    }
    list = list.subspan(count);
  }
}

template <typename Real>
void GridTile<Real>::add_to_lines(const Echoes& echoes, List list) {
  const ColumnPlan<Real>& column = *plan_.column;
  const std::size_t width = column.kernel.width();
  std::array<Real*, 16 * GaussianBatch<Real>::most> to;
  std::array<Real, GaussianBatch<Real>::most> line_offset, sign;
  std::size_t done = 0;
  const auto add_until = [&](std::size_t end) {
    kernels::grid_bricks(kernels::BrickEchoes<Real>{to.data(), pulses_.column_offset.data(), line_offset.data(),
                                                    sign.data(), pulses_.re.data(), pulses_.im.data()},
                         done, end, list.size(), plan_.longest_rows, plan_.columns, column.pieces, width, plane_);
    done = end;
  };
  for (std::size_t k = 0; k < list.size(); ++k) {
    // Between lines, with the sign of whole cycles.
    const double cycles = column.cycles_per_v * echoes.v[list[k]], whole = std::floor(cycles);
    const double low = (cycles - whole) * static_cast<double>(column.cycle) - 0.5 * static_cast<double>(width);
    const double first = std::ceil(low);
    line_offset[k] = static_cast<Real>(2 * (first - low) - 1);
    sign[k] = column.element_offset != 0 && std::fmod(whole, 2) != 0 ? Real(-1) : Real(1);
    const std::size_t line = static_cast<std::size_t>(first + static_cast<double>(grid_pad));
    const std::size_t block = pulses_.column[k] / brick_columns, at = pulses_.column[k] % brick_columns;
    for (std::size_t j = 0; j < width; ++j) {
      Brick& brick = brick_at(line + j, block);
      if (brick.since_flush == flush_interval) add_until(k);
      to[k * width + j] = flushed(brick).sum.data() + pulses_.row[k] * brick_stride + at;
      ++brick.since_flush;
    }
  }
  add_until(list.size());
}

template <typename Real>
void GridTile<Real>::weigh_rows(std::size_t first) {
  const std::size_t bins = plan_.tile_bins, stride = blocks_ * brick_columns;
  const std::size_t groups =
      (std::min(rows_at_a_time, plan_.fan.size() - first) + kernels::rows_at_once - 1) / kernels::rows_at_once;
  std::vector<Real*> sums;
  std::vector<Real> weight;  // groups x bricks x kernels::rows_at_once
  for (std::size_t block = 0; block < blocks_; ++block) {
    // The bricks of this block, and behind them those of the one before.
    sums.clear();
    std::vector<std::size_t> line;
    const std::size_t owns = of_block_[block].size();
    for (const std::size_t b : {block, block - 1})
      if (b < blocks_)
        for (Brick* brick : of_block_[b]) sums.push_back(brick->sum.data()), line.push_back(brick->line);
    weight.assign(groups * sums.size() * kernels::rows_at_once, 0);
    for (std::size_t r = 0; r < groups * kernels::rows_at_once && first + r < plan_.fan.size(); ++r)
      for (std::size_t k = 0; k < sums.size(); ++k)
        weight[(r / kernels::rows_at_once * sums.size() + k) * kernels::rows_at_once + r % kernels::rows_at_once] =
            plan_.column->weight[(first + r) * plan_.column->lines + line[k]];
    for (std::size_t n = 0; n < bins; ++n)
      for (std::size_t g = 0; g < groups; ++g) {
        const Real* own = weight.data() + g * sums.size() * kernels::rows_at_once;
        const kernels::BrickColumn<Real> bricks{sums.data(),        owns, sums.data() + owns,
                                                sums.size() - owns, own,  own + owns * kernels::rows_at_once};
        const std::size_t from = (plan_.margin + n) * brick_stride,
                          to = (g * kernels::rows_at_once * bins + n) * stride + block * brick_columns;
        kernels::weigh_bricks(bricks, from, re_.data() + to, bins * stride);
        kernels::weigh_bricks(bricks, plane_ + from, im_.data() + to, bins * stride);
      }
  }
}

template <typename Real>
void GridTile<Real>::form_beams(const BeamTransform<Real>& transform, std::size_t first, std::size_t last,
                                ComplexGrid& pressure, double& gridded, double& received) {
  if (used_ == 0) {
    pressure.middleCols(first, last - first).setZero();
    return;
  }
  for (std::size_t b = 0; b < used_; ++b) {
    Brick& brick = *room_[b];
    for (std::size_t k = 0; k < brick.flushed.size(); ++k) brick.sum[k] += brick.flushed[k];
  }
  const auto form = [&](const FanRow& row, Real* re, Real* im, std::size_t stride) {
    received += unit_ * unit_ * transform.run({re, im, stride}, grid_.data(), row.beams, unit_, first, last, pressure);
  };
  gridded += unit_ * unit_ * energy_;
  if (plan_.column) {
    const std::size_t stride = blocks_ * brick_columns, row_size = plan_.tile_bins * stride;
    for (std::size_t r = 0; r < plan_.fan.size(); ++r) {
      const std::size_t at = r % rows_at_a_time;
      if (at == 0) weigh_rows(r);
      form(plan_.fan[r], re_.data() + at * row_size, im_.data() + at * row_size, stride);
    }
  } else {
    Real* planes = room_[0]->sum.data() + plan_.margin * stride_;
    form(plan_.fan[0], planes, planes + plane_, stride_);
  }
  clear();
}

template <typename Real>
void GridTile<Real>::clear() {
  std::fill(brick_.begin(), brick_.end(), nullptr);
  for (auto& bricks : of_block_) bricks.clear();
  for (std::size_t b = 0; b < used_; ++b) {
    std::ranges::fill(room_[b]->sum, Real(0));
    room_[b]->flushed.clear();
    room_[b]->since_flush = 0;
  }
  used_ = 0;
  unit_ = energy_ = 0;
}

template class GridTile<float>;
template class GridTile<double>;

}  // namespace insonify
