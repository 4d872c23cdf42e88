#include <algorithm>
#include <cmath>

#include "beamforming/narrow_band/planar_tile_internal.hpp"

namespace insonify {
namespace {

using kernels::brick_columns;
using kernels::brick_stride;

constexpr std::size_t rows_at_a_time = 48;  // of beams that are formed together; a multiple of kernels::rows_at_once
constexpr std::size_t brick_flush_interval = 2048;  // echoes added to a brick before its sums are flushed
static_assert(rows_at_a_time % kernels::rows_at_once == 0);

template <typename Real>
kernels::Pieces<Real> pieces_of(const PolynomialPieces<Real>& p) {
  return {p.coefficient.data(), p.degree, p.lanes};
}

}  // namespace

template <typename Real>
PlanarTile<Real>::PlanarTile(const PlanarPlan<Real>& plan)
    : plan_(plan),
      blocks_((plan.across.stride + brick_columns - 1) / brick_columns),
      plane_(plan.across.tile_rows * brick_stride),
      brick_(plan.lines * blocks_, nullptr),
      of_block_(blocks_),
      re_(rows_at_a_time * plan.across.tile_bins * blocks_ * brick_columns),
      im_(rows_at_a_time * plan.across.tile_bins * blocks_ * brick_columns),
      grid_(plan.across.grid * plan.across.grid_row) {}

template <typename Real>
typename PlanarTile<Real>::Brick& PlanarTile<Real>::brick_at(std::size_t line, std::size_t block) {
  Brick*& brick = brick_[line * blocks_ + block];
  if (!brick) {
    if (used_ == room_.size()) room_.push_back(std::make_unique<Brick>(2 * plane_));
    brick = room_[used_++].get();
    brick->line = line;
    of_block_[block].push_back(brick);
  }
  // Single precision accumulates a bounded number of terms.
  if (brick->since_flush++ == brick_flush_interval) {
    brick->flushed.resize(2 * plane_, 0);
    for (std::size_t k = 0; k < 2 * plane_; ++k) brick->flushed[k] += brick->sum[k];
    brick->sum.clear();
    brick->since_flush = 1;
  }
  return *brick;
}

template <typename Real>
void PlanarTile<Real>::add_batch(const Echoes& echoes, std::span<const std::uint32_t> list) {
  const std::size_t width = plan_.kernel.width();
  std::array<Real*, 16 * echo_batch> brick;
  std::array<Real, echo_batch> line_offset, sign;
  for (std::size_t k = 0; k < list.size(); ++k) {
    // Between lines, with the sign of whole cycles.
    const double cycles = plan_.cycles_per_v * echoes.v[list[k]], whole = std::floor(cycles);
    const double low = (cycles - whole) * static_cast<double>(plan_.cycle) - 0.5 * static_cast<double>(width);
    const double first = std::ceil(low);
    line_offset[k] = static_cast<Real>(2 * (first - low) - 1);
    sign[k] = plan_.element_offset != 0 && std::fmod(whole, 2) != 0 ? Real(-1) : Real(1);
    const std::size_t line = static_cast<std::size_t>(first + static_cast<double>(grid_pad));
    const std::size_t block = pulses_.column[k] / brick_columns, column = pulses_.column[k] % brick_columns;
    for (std::size_t j = 0; j < width; ++j)
      brick[k * width + j] = brick_at(line + j, block).sum.data() + pulses_.row[k] * brick_stride + column;
  }
  kernels::grid_bricks(kernels::PlanarEchoes<Real>{brick.data(), pulses_.column_offset.data(), line_offset.data(),
                                                   sign.data(), pulses_.re.data(), pulses_.im.data()},
                       list.size(), plan_.across.longest_rows, pieces_of(plan_.across.columns),
                       pieces_of(plan_.lines_of), width, plane_);
}

template <typename Real>
double PlanarTile<Real>::add(const GriddingInput& input, std::span<const std::uint32_t> list, std::size_t first_bin) {
  double energy = 0;
  for (; !list.empty(); list = list.subspan(std::min(echo_batch, list.size()))) {
    const auto some = list.first(std::min(echo_batch, list.size()));
    energy += pulses_.sample(plan_.across, input, some, first_bin);
    add_batch(input.echoes, some);
  }
  return energy;
}

template <typename Real>
void PlanarTile<Real>::weigh_rows(std::size_t first) {
  const std::size_t bins = plan_.across.tile_bins, stride = blocks_ * brick_columns;
  const std::size_t groups =
      (std::min(rows_at_a_time, plan_.rows.size() - first) + kernels::rows_at_once - 1) / kernels::rows_at_once;
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
    for (std::size_t r = 0; r < groups * kernels::rows_at_once && first + r < plan_.rows.size(); ++r)
      for (std::size_t k = 0; k < sums.size(); ++k)
        weight[(r / kernels::rows_at_once * sums.size() + k) * kernels::rows_at_once + r % kernels::rows_at_once] =
            plan_.weight[(first + r) * plan_.lines + line[k]];
    for (std::size_t n = 0; n < bins; ++n)
      for (std::size_t g = 0; g < groups; ++g) {
        const Real* own = weight.data() + g * sums.size() * kernels::rows_at_once;
        const kernels::BrickColumn<Real> bricks{sums.data(),        owns, sums.data() + owns,
                                                sums.size() - owns, own,  own + owns * kernels::rows_at_once};
        const std::size_t from = (plan_.across.margin + n) * brick_stride,
                          to = (g * kernels::rows_at_once * bins + n) * stride + block * brick_columns;
        kernels::weigh_bricks(bricks, from, re_.data() + to, bins * stride);
        kernels::weigh_bricks(bricks, plane_ + from, im_.data() + to, bins * stride);
      }
  }
}

template <typename Real>
double PlanarTile<Real>::form_beams(const BeamTransform<Real>& transform, double unit, std::size_t first,
                                    std::size_t last, ComplexGrid& pressure) {
  for (std::size_t b = 0; b < used_; ++b) {
    Brick& brick = *room_[b];
    for (std::size_t k = 0; k < brick.flushed.size(); ++k) brick.sum[k] += brick.flushed[k];
  }
  const std::size_t stride = blocks_ * brick_columns, row_size = plan_.across.tile_bins * stride;
  double energy = 0;
  for (std::size_t r = 0; r < plan_.rows.size(); ++r) {
    const std::size_t at = r % rows_at_a_time;
    if (at == 0) weigh_rows(r);
    energy += transform.run({re_.data() + at * row_size, im_.data() + at * row_size, stride}, grid_.data(),
                            plan_.rows[r].beams, unit, first, last, pressure);
  }
  clear();
  return energy;
}

template <typename Real>
void PlanarTile<Real>::clear() {
  std::fill(brick_.begin(), brick_.end(), nullptr);
  for (auto& bricks : of_block_) bricks.clear();
  for (std::size_t b = 0; b < used_; ++b) {
    room_[b]->sum.clear();
    room_[b]->flushed.clear();
    room_[b]->since_flush = 0;
  }
  used_ = 0;
}

template class PlanarTile<float>;
template class PlanarTile<double>;

}  // namespace insonify
