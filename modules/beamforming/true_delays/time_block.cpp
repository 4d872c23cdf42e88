// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "beamforming/gridded/gridding_loops_internal.hpp"
#include "beamforming/true_delays/time_block_internal.hpp"

namespace insonify {
namespace {

using kernels::lines_at_once;

constexpr std::size_t chunk_row = 2 * lines_at_once;  // numbers of a harmonic in a chunk of frequencies

constexpr std::size_t beams_ahead = 8;  // that are fetched into the cache

kernels::TimeFactor factor_of(const CurvatureSeries& curvature, std::size_t term) {
  return {curvature.along.data() + term * curvature.powers * 2 * curvature.stride, curvature.powers, curvature.stride};
}

/// Times of a tile within the block, from -1 to 1.
std::array<float, time_tile> positions_in(const CurvatureSeries& curvature, double first, double step) {
  std::array<float, time_tile> position;
  for (std::size_t n = 0; n < time_tile; ++n)
    position[n] = static_cast<float>(
        std::clamp((first + static_cast<double>(n) * step - curvature.middle) / curvature.half, -1.0, 1.0));
  return position;
}

kernels::RowMix mix_of(const CurvatureSeries& curvature) {
  return {curvature.rows.data(), curvature.ins.size(), curvature.ins.data(), curvature.most_ins};
}

template <typename Numbers>
void grow(Numbers& numbers, std::size_t size) {
  if (numbers.size() < size) numbers.resize(size);
}

template <typename Complex>
float* floats_of(Complex* numbers) {
  return reinterpret_cast<float*>(numbers);
}

}  // namespace

BlockTransforms::BlockTransforms(const TrueDelayPlan& plan)
    : to_harmonics({plan.grid, time_tile, 1, plan.grid_stride, false}, FFTW_FORWARD),
      to_frequencies({.length = plan.fine, .in_place = false}, FFTW_FORWARD),
      to_bins({.length = plan.cycle, .in_place = false}, FFTW_BACKWARD),
      to_directions({plan.grid, time_tile, 1, plan.grid_stride, false}, FFTW_BACKWARD) {}

BlockWorkspace::BlockWorkspace(const TrueDelayPlan& plan, const BlockTransforms& transforms)
    : plan_(plan),
      transforms_(transforms),
      re_((plan.fine + time_tile) * plan.grid_stride),
      im_((plan.fine + time_tile) * plan.grid_stride),
      tile_(plan.grid_stride * time_tile),
      bin_row_(plan.cycle + lines_at_once),
      lines_(plan.chunks.size() * plan.rows() * chunk_row),
      chunk_(std::max(plan.rows(), plan.chunks.size()) * chunk_row),
      across_(plan.grid * 2 * time_tile),
      position_(plan.grid, static_cast<std::uint32_t>(plan.rows())),
      beam_(2 * time_tile),
      touched_(plan.fine / time_tile + 2),
      bins_row_((plan.cycle + time_tile - 1) / time_tile * time_tile + 8) {
  for (std::size_t r = 0; r < plan.rows(); ++r)
    position_[(r + plan.grid - plan.most) % plan.grid] = static_cast<std::uint32_t>(r);
  // Frequencies beyond what bins can tell fold, as they do in any sampled image.
  const auto cycle = static_cast<std::ptrdiff_t>(plan.cycle);
  for (const std::size_t chunk : plan.chunks) {
    const std::ptrdiff_t line = static_cast<std::ptrdiff_t>(plan.line_of((chunk + 1) * lines_at_once - 1)) -
                                static_cast<std::ptrdiff_t>(lines_at_once - 1);
    bin_.push_back(static_cast<std::uint32_t>((line % cycle + cycle) % cycle));
  }
}

TimeBlock::TimeBlock(const TrueDelayPlan& plan, const RowFits& fits, double first_in, double last_in)
    : first(first_in),
      last(last_in),
      echo_curvature(curvature_series(plan, fits, true, first, last)),
      beam_curvature(curvature_series(plan, fits, false, first, last)) {}

void BlockWorkspace::add_image(const TimeBlock& block, ComplexGrid& pressure) {
  if (unit_ == 0) return;
  const TrueDelayPlan& plan = plan_;
  const CurvatureSeries &received = block.echo_curvature, &undone = block.beam_curvature;
  const std::size_t tile = time_tile * plan.grid_stride, rows = plan.rows() + 1;
  grow(harmonics_, std::max(received.terms, undone.terms) * tile);
  grow(directions_, undone.terms * tile);
  grow(mixed_, std::max(received.most_ins, undone.most_ins) * time_tile * chunk_row);
  grow(spectrum_, received.band[0] * rows * plan.fine_row);
  grow(row_, received.band[0] * plan.fine);
  grow(bins_, undone.band[0] * rows * bins_row_);
  receive(received);
  to_chunks(received);
  through_elements();
  to_bins(undone);
  add_beams(block, pressure);
}

kernels::TimePlanes BlockWorkspace::planes_of(Numbers& numbers) const {
  return {floats_of(numbers.data()), plan_.grid, 2 * plan_.grid_stride, 2 * time_tile * plan_.grid_stride};
}

kernels::PositionRows BlockWorkspace::rows_of(Numbers& numbers, std::size_t length, std::size_t n0) const {
  const std::size_t rows = plan_.rows();
  return {floats_of(numbers.data() + n0), position_.data(), static_cast<std::uint32_t>(rows), 2 * length,
          2 * (rows + 1) * length};
}

void BlockWorkspace::receive(const CurvatureSeries& curvature) {
  const TrueDelayPlan& plan = plan_;
  const std::size_t tile = time_tile * plan.grid_stride, rows = plan.rows() + 1;
  for (std::size_t n0 = 0; n0 < plan.fine; n0 += time_tile) {
    if (!touched_[n0 / time_tile]) {
      for (std::size_t r = 0; r < curvature.band[0] * rows; ++r)
        std::fill_n(floats_of(spectrum_.data() + r * plan.fine_row + n0), 2 * time_tile, 0.0F);
      continue;
    }
    const auto time = positions_in(curvature, start_time_ + static_cast<double>(n0) * plan.fine_step, plan.fine_step);
    for (std::size_t q = 0; q < curvature.terms; ++q) {
      kernels::weigh(factor_of(curvature, q), time.data(), re_.data() + n0 * plan.grid_stride,
                     im_.data() + n0 * plan.grid_stride, plan.grid, plan.grid_stride, floats_of(tile_.data()));
      transforms_.to_harmonics.run(tile_.data(), harmonics_.data() + q * tile);
    }
    kernels::mix_to_rows(mix_of(curvature), planes_of(harmonics_), rows_of(spectrum_, plan.fine_row, n0),
                         mixed_.data());
  }
  // For the next block, while it is near.
  for (std::size_t k = 0; k <= plan.fine / time_tile; ++k)
    if (touched_[k]) {
      std::fill_n(re_.data() + k * tile, tile, 0.0F);
      std::fill_n(im_.data() + k * tile, tile, 0.0F);
    }
}

void BlockWorkspace::to_chunks(const CurvatureSeries& curvature) {
  const TrueDelayPlan& plan = plan_;
  const std::size_t powers = curvature.band[0];
  for (std::size_t r = 0; r < plan.rows(); ++r) {
    for (std::size_t s = 0; s < powers; ++s) {
      Complex* row = spectrum_.data() + (s * (plan.rows() + 1) + r) * plan.fine_row;
      for (std::size_t n = 0; n < plan.fine; n += 8) __builtin_prefetch(row + plan.fine_row + n, 0, 2);
      transforms_.to_frequencies.run(row, row_.data() + s * plan.fine);
    }
    kernels::sum_powers({powers, TrueDelayPlan::most_powers, plan.line_power.data()}, floats_of(row_.data()),
                        2 * plan.fine, plan.chunks.data(), plan.chunks.size(), lines_.data() + r * chunk_row,
                        plan.rows() * chunk_row);
  }
}

void BlockWorkspace::through_elements() {
  const TrueDelayPlan& plan = plan_;
  const std::size_t chunk = plan.rows() * chunk_row, elements = plan.elements();
  for (std::size_t i = 0; i < plan.chunks.size(); ++i) {
    std::fill_n(chunk_.data(), chunk, 0.0F);
    const kernels::ElementTaps taps{elements, plan.taps, plan.tap_row.data() + i * elements,
                                    plan.tap_weight.data() + i * elements * plan.taps * lines_at_once};
    kernels::through_elements(taps, plan.element_weight.data() + i * elements * lines_at_once,
                              lines_.data() + i * chunk, chunk_.data());
    std::copy_n(chunk_.data(), chunk, lines_.data() + i * chunk);
  }
}

void BlockWorkspace::to_bins(const CurvatureSeries& curvature) {
  const TrueDelayPlan& plan = plan_;
  const std::size_t rows = plan.rows(), count = plan.chunks.size();
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t i = 0; i < count; ++i) {
      const float* line = lines_.data() + (i * rows + r) * chunk_row;
      __builtin_prefetch(line + 2 * chunk_row);
      std::copy_n(line, chunk_row, chunk_.data() + i * chunk_row);
    }
    for (std::size_t s = 0; s < curvature.band[0]; ++s) {
      std::fill(bin_row_.begin(), bin_row_.end(), Complex(0));
      kernels::add_power(chunk_.data(), count, plan.line_power.data() + s * lines_at_once,
                         TrueDelayPlan::most_powers * lines_at_once, bin_.data(), floats_of(bin_row_.data()));
      for (std::size_t k = 0; k < lines_at_once; ++k) bin_row_[k] += bin_row_[plan.cycle + k];
      transforms_.to_bins.run(bin_row_.data(), bins_.data() + (s * (rows + 1) + r) * bins_row_);
    }
  }
}

void BlockWorkspace::form_directions(const CurvatureSeries& curvature, std::size_t n0, double first) {
  const TrueDelayPlan& plan = plan_;
  const std::size_t tile = time_tile * plan.grid_stride;
  kernels::mix_from_rows(mix_of(curvature), rows_of(bins_, bins_row_, n0), planes_of(harmonics_), mixed_.data());
  for (std::size_t q = 0; q < curvature.terms; ++q)
    transforms_.to_directions.run(harmonics_.data() + q * tile, directions_.data() + q * tile);
  const auto time = positions_in(curvature, plan.axis.time_of(first), plan.axis.step);
  kernels::weigh_back(factor_of(curvature, 0), time.data(), floats_of(directions_.data()), curvature.terms, 2 * tile,
                      plan.grid, plan.grid_stride, across_.data());
}

void BlockWorkspace::add_beams(const TimeBlock& block, ComplexGrid& pressure) {
  const TrueDelayPlan& plan = plan_;
  const std::size_t width = plan.kernel.width();
  const auto begin = static_cast<std::ptrdiff_t>(block.first) - static_cast<std::ptrdiff_t>(plan.guard);
  const auto end = std::min(static_cast<std::ptrdiff_t>(block.last) + static_cast<std::ptrdiff_t>(plan.guard),
                            static_cast<std::ptrdiff_t>(plan.axis.bins));
  for (std::size_t n0 = 0; n0 < plan.cycle; n0 += time_tile) {
    const std::ptrdiff_t first = begin + static_cast<std::ptrdiff_t>(n0);
    const std::ptrdiff_t from = std::max<std::ptrdiff_t>(first, 0),
                         to = std::min<std::ptrdiff_t>(first + static_cast<std::ptrdiff_t>(time_tile), end);
    if (from >= to) continue;
    form_directions(block.beam_curvature, n0, static_cast<double>(first));
    for (std::size_t b = 0; b < plan.u_beam.size(); ++b) {
      kernels::interpolate(plan.beam_weight.data() + b * width, plan.beam_row.data() + b * width, width, across_.data(),
                           2 * time_tile, 2 * time_tile, beam_.data());
      double* sum = reinterpret_cast<double*>(&pressure(static_cast<Eigen::Index>(b), from));
      // Rows of the image are far apart in memory.
      const auto later = static_cast<Eigen::Index>(std::min(b + beams_ahead, plan.u_beam.size() - 1));
      for (std::ptrdiff_t n = from; n < to; n += 4) __builtin_prefetch(&pressure(later, n), 1);
      const double* share = beam_.data() + 2 * (from - first);
      for (std::ptrdiff_t n = 0; n < 2 * (to - from); ++n) sum[n] += unit_ * share[n];
    }
  }
}

}  // namespace insonify
