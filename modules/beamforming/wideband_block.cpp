#include <algorithm>
#include <array>
#include <cmath>

#include "beamforming/wideband_block_internal.hpp"

namespace insonify {
namespace {

using kernels::lines_at_once;

constexpr std::size_t chunk_row = 2 * lines_at_once;  // numbers of a harmonic in a chunk of frequencies

constexpr std::size_t beams_ahead = 8, rows_ahead = 6;  // that are fetched into the cache

kernels::TimeFactor factor_of(const BendSeries& bend, std::size_t term) {
  return {bend.along.data() + term * bend.powers * 2 * bend.stride, bend.powers, bend.stride};
}

/// A time within the block, from -1 to 1.
float place_in(const BendSeries& bend, double time) {
  return static_cast<float>(std::clamp((time - bend.middle) / bend.half, -1.0, 1.0));
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

WidebandTransforms::WidebandTransforms(const WidebandPlan& plan)
    : to_harmonics(plan.grid, wideband_tile, plan.grid_stride, FFTW_FORWARD),
      to_frequencies(plan.fine, 1, plan.fine, FFTW_FORWARD),
      to_directions(plan.grid, wideband_tile, plan.grid_stride, FFTW_BACKWARD),
      to_bins(plan.cycle, 1, FFTW_BACKWARD) {}

WidebandRoom::WidebandRoom(const WidebandPlan& plan, const WidebandTransforms& transforms)
    : plan_(plan),
      transforms_(transforms),
      re_((plan.fine + wideband_tile) * plan.grid_stride),
      im_((plan.fine + wideband_tile) * plan.grid_stride),
      tile_(plan.grid_stride * wideband_tile),
      lines_(plan.chunks.size() * plan.rows() * chunk_row),
      chunk_(plan.rows() * chunk_row),
      sum_re_(plan.grid_stride * wideband_tile),
      sum_im_(plan.grid_stride * wideband_tile),
      across_(plan.grid * 2 * wideband_tile),
      scratch_(std::max<std::size_t>(plan.pulse.lanes, 8)),
      beam_(2 * wideband_tile),
      touched_(plan.fine / wideband_tile + 2),
      bins_row_((plan.cycle + 15) / 8 * 8) {
  for (std::size_t r = 0; r < plan.rows(); ++r) place_.push_back((r + plan.grid - plan.most) % plan.grid);
}

WidebandBlock::WidebandBlock(const WidebandPlan& plan, double first_in, double last_in)
    : first(first_in),
      last(last_in),
      received(bend_of_echoes(plan, first, last)),
      undone(bend_of_beams(plan, first, last)) {}

void WidebandRoom::add_image(const WidebandBlock& block, ComplexGrid& pressure) {
  if (unit_ == 0) return;
  const WidebandPlan& plan = plan_;
  const BendSeries &received = block.received, &undone = block.undone;
  const std::size_t tile = wideband_tile * plan.grid_stride;
  grow(harmonics_, std::max(received.terms, undone.band[0]) * tile);
  grow(mixed_, std::max(received.band[0], undone.terms) * tile);
  grow(spectrum_, received.band[0] * plan.rows() * plan.fine_row);
  grow(row_, received.band[0] * plan.fine);
  grow(bins_, undone.band[0] * plan.rows() * bins_row_);
  receive(received);
  to_chunks(received);
  through_elements(undone);
  add_beams(block, pressure);
}

void WidebandRoom::mix(const BendSeries& bend) {
  const std::size_t tile = wideband_tile * plan_.grid_stride, below = plan_.most / 8 + 1;
  const kernels::RowMix rows{bend.rows.data(), bend.ins.size(), bend.ins.data(), bend.most_ins};
  kernels::MixedPlanes planes{floats_of(harmonics_.data()),
                              floats_of(mixed_.data()),
                              2 * tile,
                              2 * tile,
                              2 * plan_.grid_stride,
                              wideband_tile,
                              0,
                              below};
  kernels::mix_rows(rows, planes);
  planes.first = std::max(below, (plan_.grid - plan_.most) / 8);
  planes.last = plan_.grid / 8;
  kernels::mix_rows(rows, planes);
}

void WidebandRoom::receive(const BendSeries& bend) {
  const WidebandPlan& plan = plan_;
  const std::size_t tile = wideband_tile * plan.grid_stride, powers = bend.band[0];
  for (std::size_t n0 = 0; n0 < plan.fine; n0 += wideband_tile) {
    const std::size_t count = std::min(wideband_tile, plan.fine - n0);
    const bool touched = touched_[n0 / wideband_tile];
    for (std::size_t q = 0; touched && q < bend.terms; ++q) {
      for (std::size_t n = 0; n < count; ++n) {
        const std::size_t at = (n0 + n) * plan.grid_stride;
        const double time = start_time_ + static_cast<double>(n0 + n) * plan.fine_step;
        kernels::weigh_row(factor_of(bend, q), place_in(bend, time), re_.data() + at, im_.data() + at, plan.grid,
                           floats_of(tile_.data() + n * plan.grid_stride));
      }
      transforms_.to_harmonics.run(tile_.data(), harmonics_.data() + q * tile);
    }
    if (touched) mix(bend);
    // One row per harmonic.
    for (std::size_t s = 0; s < powers; ++s)
      for (std::size_t r = 0; r < plan.rows(); ++r) {
        const Complex* from = mixed_.data() + s * tile + place_[r];
        Complex* to = spectrum_.data() + (s * plan.rows() + r) * plan.fine_row + n0;
        __builtin_prefetch(to + rows_ahead * plan.fine_row, 1);
        __builtin_prefetch(to + rows_ahead * plan.fine_row + 8, 1);
        for (std::size_t n = 0; n < count; ++n) to[n] = touched ? from[n * plan.grid_stride] : Complex(0);
      }
  }
}

void WidebandRoom::to_chunks(const BendSeries& bend) {
  const WidebandPlan& plan = plan_;
  const std::size_t powers = bend.band[0];
  for (std::size_t r = 0; r < plan.rows(); ++r) {
    for (std::size_t s = 0; s < powers; ++s)
      transforms_.to_frequencies.run(spectrum_.data() + (s * plan.rows() + r) * plan.fine_row,
                                     row_.data() + s * plan.fine);
    kernels::sum_powers({powers, WidebandPlan::most_powers, plan.line_power.data()}, floats_of(row_.data()),
                        2 * plan.fine, plan.chunks.data(), plan.chunks.size(), lines_.data() + r * chunk_row,
                        plan.rows() * chunk_row);
  }
}

void WidebandRoom::through_elements(const BendSeries& bend) {
  const WidebandPlan& plan = plan_;
  const std::size_t chunk = plan.rows() * chunk_row, elements = plan.elements(), powers = bend.band[0];
  const auto cycle = static_cast<std::ptrdiff_t>(plan.cycle);
  std::fill_n(bins_.data(), powers * plan.rows() * bins_row_, Complex(0));
  for (std::size_t i = 0; i < plan.chunks.size(); ++i) {
    std::fill(chunk_.begin(), chunk_.end(), 0.0F);
    const kernels::ElementTaps taps{elements, plan.taps, plan.tap_row.data() + i * elements,
                                    plan.tap_weight.data() + i * elements * plan.taps * lines_at_once};
    kernels::through_elements(taps, plan.element_weight.data() + i * elements * lines_at_once,
                              lines_.data() + i * chunk, chunk_.data());
    // Frequencies beyond what bins can tell fold, as they do in any sampled image.
    const std::ptrdiff_t line = static_cast<std::ptrdiff_t>(plan.line_of((plan.chunks[i] + 1) * lines_at_once - 1)) -
                                static_cast<std::ptrdiff_t>(lines_at_once - 1);
    const std::ptrdiff_t bin = (line % cycle + cycle) % cycle;
    kernels::add_powers(
        {powers, WidebandPlan::most_powers, plan.line_power.data() + i * WidebandPlan::most_powers * lines_at_once},
        chunk_.data(), plan.rows(), floats_of(bins_.data() + bin), bins_row_, plan.rows() * bins_row_);
  }
  for (std::size_t r = 0; r < powers * plan.rows(); ++r) {
    Complex* bin = bins_.data() + r * bins_row_;
    for (std::size_t k = 0; k < lines_at_once; ++k) bin[k] += bin[plan.cycle + k];
    transforms_.to_bins.run(bin);
  }
}

void WidebandRoom::form_directions(const BendSeries& bend, std::size_t n0, double first) {
  const WidebandPlan& plan = plan_;
  const std::size_t tile = wideband_tile * plan.grid_stride, rows = plan.rows(), at_once = 8,
                    count = std::min(wideband_tile, plan.cycle - n0);
  for (std::size_t s = 0; s < bend.band[0]; ++s)
    for (std::size_t r0 = 0; r0 < rows; r0 += at_once)
      for (std::size_t n = 0; n < count; ++n)
        for (std::size_t r = r0; r < std::min(r0 + at_once, rows); ++r)
          harmonics_[s * tile + n * plan.grid_stride + place_[r]] = bins_[(s * rows + r) * bins_row_ + n0 + n];
  mix(bend);
  std::fill(sum_re_.begin(), sum_re_.end(), 0.0F);
  std::fill(sum_im_.begin(), sum_im_.end(), 0.0F);
  for (std::size_t q = 0; q < bend.terms; ++q) {
    transforms_.to_directions.run(mixed_.data() + q * tile, tile_.data());
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t at = n * plan.grid_stride;
      const float time = place_in(bend, plan.time_of(first + static_cast<double>(n)));
      kernels::weigh_back(factor_of(bend, q), time, floats_of(tile_.data() + at), plan.grid, sum_re_.data() + at,
                          sum_im_.data() + at);
    }
  }
}

void WidebandRoom::add_beams(const WidebandBlock& block, ComplexGrid& pressure) {
  const WidebandPlan& plan = plan_;
  const std::size_t width = plan.kernel.width();
  const auto begin = static_cast<std::ptrdiff_t>(block.first) - static_cast<std::ptrdiff_t>(plan.guard);
  const auto end = std::min(static_cast<std::ptrdiff_t>(block.last) + static_cast<std::ptrdiff_t>(plan.guard),
                            static_cast<std::ptrdiff_t>(plan.axis.bins));
  for (std::size_t n0 = 0; n0 < plan.cycle; n0 += wideband_tile) {
    const std::ptrdiff_t first = begin + static_cast<std::ptrdiff_t>(n0);
    const std::ptrdiff_t from = std::max<std::ptrdiff_t>(first, 0),
                         to = std::min<std::ptrdiff_t>(first + static_cast<std::ptrdiff_t>(wideband_tile), end);
    if (from >= to) continue;
    form_directions(block.undone, n0, static_cast<double>(first));
    for (std::size_t g = 0; g < plan.grid; ++g)
      for (std::size_t n = 0; n < wideband_tile; ++n) {
        across_[2 * (g * wideband_tile + n)] = sum_re_[n * plan.grid_stride + g];
        across_[2 * (g * wideband_tile + n) + 1] = sum_im_[n * plan.grid_stride + g];
      }
    for (std::size_t b = 0; b < plan.u_beam.size(); ++b) {
      kernels::take_beam(plan.beam_weight.data() + b * width, plan.beam_row.data() + b * width, width, across_.data(),
                         2 * wideband_tile, 2 * wideband_tile, beam_.data());
      double* sum = reinterpret_cast<double*>(&pressure(static_cast<Eigen::Index>(b), from));
      // Rows of the image are far apart in memory.
      const auto later = static_cast<Eigen::Index>(std::min(b + beams_ahead, plan.u_beam.size() - 1));
      for (std::ptrdiff_t n = from; n < to; n += 4) __builtin_prefetch(&pressure(later, n), 1);
      const float* part = beam_.data() + 2 * (from - first);
      for (std::ptrdiff_t n = 0; n < 2 * (to - from); ++n) sum[n] += unit_ * static_cast<double>(part[n]);
    }
  }
}

}  // namespace insonify
