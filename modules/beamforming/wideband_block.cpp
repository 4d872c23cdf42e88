#include <algorithm>
#include <array>
#include <cmath>

#include "beamforming/wideband_block_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using kernels::lines_at_once;

kernels::TimeFactor factor_of(const BendSeries& bend, std::size_t term) {
  return {bend.along.data() + term * bend.powers * 2 * bend.stride, bend.powers, bend.stride};
}

/// A time within the block, from -1 to 1.
float place_in(const BendSeries& bend, double time) {
  return static_cast<float>(std::clamp((time - bend.middle) / bend.half, -1.0, 1.0));
}

}  // namespace

WidebandTransforms::WidebandTransforms(const WidebandPlan& plan)
    : to_harmonics(plan.grid, 1, FFTW_FORWARD),
      to_directions(plan.grid, wideband_tile, wideband_tile_row, FFTW_BACKWARD),
      to_frequencies(plan.fine, 1, FFTW_FORWARD),
      to_bins(plan.cycle, 1, FFTW_BACKWARD) {}

WidebandRoom::WidebandRoom(const WidebandPlan& plan, const WidebandTransforms& transforms)
    : plan_(plan),
      transforms_(transforms),
      re_((plan.fine + wideband_tile) * plan.grid_stride),
      im_((plan.fine + wideband_tile) * plan.grid_stride),
      tile_(std::max(plan.grid, plan.grid_stride) * wideband_tile_row),
      spectrum_(plan.rows() * plan.fine_row),
      elements_(plan.chunks.size() * plan.elements() * 2 * lines_at_once),
      scratch_(std::max<std::size_t>(plan.pulse.lanes, 8)),
      sums_(plan.u_beam.size() * 2 * wideband_tile),
      start_(2 * plan.elements()),
      step_(2 * plan.elements() * lines_at_once),
      line_(lines_at_once),
      touched_(plan.fine / wideband_tile + 2),
      bins_row_((plan.cycle + 15) / 8 * 8) {}

WidebandBlock::WidebandBlock(const WidebandPlan& plan, double first_in, double last_in)
    : first(first_in), last(last_in) {
  const auto guard = static_cast<double>(plan.guard), bins = static_cast<double>(plan.axis.bins);
  received = bend_of_echoes(plan, plan.time_of(first) - plan.reach, plan.time_of(last) + plan.reach);
  undone = bend_of_beams(plan, plan.time_of(std::max(first - guard, 0.0)), plan.time_of(std::min(last + guard, bins)));
}

void WidebandRoom::add_image(const WidebandBlock& block, ComplexGrid& pressure) {
  if (unit_ == 0) return;
  std::fill(elements_.begin(), elements_.end(), 0.0F);
  for (std::size_t q = 0; q < block.received.terms; ++q) add_echo_term(block.received, q);
  for (std::size_t k = 0; k < elements_.size(); ++k)
    elements_[k] *= plan_.element_weight[k / (2 * lines_at_once) * lines_at_once + k % lines_at_once];
  add_beams(block, pressure);
}

template <typename Visit>
void WidebandRoom::each_chunk(const BendSeries& bend, std::size_t term, Visit&& visit) {
  const WidebandPlan& plan = plan_;
  const std::size_t elements = plan.elements();
  const double* delay = bend.delay.data() + term * elements;
  // exp(2 pi i F delay), F = f_c - line / seconds: from chunk to chunk by a factor, away from the carrier.
  std::vector<std::complex<double>> carrier(elements), turn(elements), now;
  for (std::size_t m = 0; m < elements; ++m) {
    const double cycles = plan.head.pulse.centre_frequency * delay[m], each = -delay[m] / plan.seconds();
    carrier[m] = std::polar(1.0, 2 * pi * (cycles - std::floor(cycles)));
    turn[m] = std::polar(1.0, 2 * pi * each * static_cast<double>(lines_at_once));
    const std::complex<double> one = std::polar(1.0, 2 * pi * each);
    std::complex<double> power = 1;
    for (std::size_t l = 0; l < lines_at_once; ++l, power *= one) {
      step_[2 * m * lines_at_once + l] = static_cast<float>(power.real());
      step_[(2 * m + 1) * lines_at_once + l] = static_cast<float>(power.imag());
    }
  }
  const auto one_chunk = [&](std::size_t i) {
    const std::size_t first = plan.chunks[i] * lines_at_once;
    for (std::size_t l = 0; l < lines_at_once; ++l)
      line_[l] = static_cast<float>(plan.line_of(first + l) / (plan.seconds() * plan.half_band));
    for (std::size_t m = 0; m < elements; ++m) {
      start_[2 * m] = static_cast<float>(now[m].real());
      start_[2 * m + 1] = static_cast<float>(now[m].imag());
    }
    const float* rest = bend.rest.empty() ? nullptr : bend.rest.data() + term * elements * 2 * bend.rest_powers;
    visit(kernels::ElementTaps{elements, plan.taps, plan.tap_row.data() + i * elements,
                               plan.tap_weight.data() + i * elements * plan.taps * lines_at_once},
          kernels::ElementTurns{start_.data(), step_.data(), rest, bend.rest_powers, line_.data()}, first,
          elements_.data() + i * elements * 2 * lines_at_once);
  };
  now = carrier;
  std::size_t i = 0;
  for (; i < plan.chunks.size() && 2 * plan.chunks[i] * lines_at_once < plan.fine; ++i) {
    one_chunk(i);
    for (std::size_t m = 0; m < elements; ++m) now[m] *= turn[m];
  }
  now = carrier;
  for (std::size_t back = plan.chunks.size(); back-- > i;) {
    for (std::size_t m = 0; m < elements; ++m) now[m] *= std::conj(turn[m]);
    one_chunk(back);
  }
}

void WidebandRoom::add_echo_term(const BendSeries& bend, std::size_t term) {
  const WidebandPlan& plan = plan_;
  const kernels::TimeFactor factor = factor_of(bend, term);
  for (std::size_t n0 = 0; n0 < plan.fine; n0 += wideband_tile) {
    const std::size_t count = std::min(wideband_tile, plan.fine - n0);
    if (!touched_[n0 / wideband_tile]) {
      for (std::size_t r = 0; r < plan.rows(); ++r)
        std::fill_n(spectrum_.data() + r * plan.fine_row + n0, count, Complex(0));
      continue;
    }
    for (std::size_t n = 0; n < count; ++n) {
      Complex* line = tile_.data() + n * plan.grid_stride;
      const double time = start_time_ + static_cast<double>(n0 + n) * plan.fine_step;
      kernels::weigh_row(factor, place_in(bend, time), re_.data() + (n0 + n) * plan.grid_stride,
                         im_.data() + (n0 + n) * plan.grid_stride, plan.grid, reinterpret_cast<float*>(line));
      transforms_.to_harmonics.run(line);
    }
    // One row per harmonic now; directions are counted from the middle of the period.
    for (std::size_t r = 0; r < plan.rows(); ++r) {
      const Complex* from = tile_.data() + (r + plan.grid - plan.most) % plan.grid;
      Complex* to = spectrum_.data() + r * plan.fine_row + n0;
      const float sign = (r + plan.most) % 2 == 0 ? 1.0F : -1.0F;
      for (std::size_t n = 0; n < count; ++n) to[n] = sign * from[n * plan.grid_stride];
    }
  }
  for (std::size_t r = 0; r < plan.rows(); ++r) transforms_.to_frequencies.run(spectrum_.data() + r * plan.fine_row);
  each_chunk(bend, term, [&](const auto& taps, const auto& turns, std::size_t line, float* x) {
    kernels::gather_elements(taps, turns, reinterpret_cast<const float*>(spectrum_.data() + line), plan.fine_row, x);
  });
}

void WidebandRoom::form_beam_term(const BendSeries& bend, std::size_t term, Complex* bins) {
  const WidebandPlan& plan = plan_;
  const std::size_t top = plan.top_line();
  spectrum_.clear();
  each_chunk(bend, term, [&](const auto& taps, const auto& turns, std::size_t line, const float* x) {
    kernels::scatter_elements(taps, turns, x, reinterpret_cast<float*>(spectrum_.data() + line), plan.fine_row);
  });
  for (std::size_t r = 0; r < plan.rows(); ++r) {
    const Complex* line = spectrum_.data() + r * plan.fine_row;
    Complex* bin = bins + r * bins_row_;
    // Frequencies beyond what bins can tell fold, as they do in any sampled image.
    std::fill_n(bin, plan.cycle, Complex(0));
    for (std::size_t l = 0, k = 0; l <= top; ++l, k = k + 1 == plan.cycle ? 0 : k + 1) bin[k] += line[l];
    for (std::size_t l = 1, k = plan.cycle - 1; l <= top; ++l, k = k == 0 ? plan.cycle - 1 : k - 1)
      bin[k] += line[plan.fine - l];
    kernels::scale_row(reinterpret_cast<const float*>(bin), plan.row_factor[r], 2 * plan.cycle,
                       reinterpret_cast<float*>(bin));
    transforms_.to_bins.run(bin);
  }
}

void WidebandRoom::add_beams(const WidebandBlock& block, ComplexGrid& pressure) {
  const WidebandPlan& plan = plan_;
  const BendSeries& bend = block.undone;
  const std::size_t width = plan.kernel.width();
  while (bins_.size() < bend.terms) bins_.push_back(std::make_unique<Spectrum>(plan.rows() * bins_row_));
  for (std::size_t q = 0; q < bend.terms; ++q) form_beam_term(bend, q, bins_[q]->data());
  const auto begin = static_cast<std::ptrdiff_t>(block.first) - static_cast<std::ptrdiff_t>(plan.guard);
  const auto end = std::min(static_cast<std::ptrdiff_t>(block.last) + static_cast<std::ptrdiff_t>(plan.guard),
                            static_cast<std::ptrdiff_t>(plan.axis.bins));
  std::array<float, wideband_tile> time;
  for (std::size_t n0 = 0; n0 < plan.cycle; n0 += wideband_tile) {
    const std::ptrdiff_t first = begin + static_cast<std::ptrdiff_t>(n0);
    const std::ptrdiff_t from = std::max<std::ptrdiff_t>(first, 0),
                         to = std::min<std::ptrdiff_t>(first + static_cast<std::ptrdiff_t>(wideband_tile), end);
    if (from >= to) continue;
    const std::size_t count = std::min(wideband_tile, plan.cycle - n0);
    for (std::size_t n = 0; n < wideband_tile; ++n)
      time[n] = place_in(bend, plan.time_of(static_cast<double>(first) + static_cast<double>(n)));
    std::fill(sums_.begin(), sums_.end(), 0.0F);
    for (std::size_t q = 0; q < bend.terms; ++q) {
      std::fill_n(tile_.data() + (plan.most + 1) * wideband_tile_row, (plan.grid - plan.rows()) * wideband_tile_row,
                  Complex(0));
      for (std::size_t r = 0; r < plan.rows(); ++r)
        std::copy_n(bins_[q]->data() + r * bins_row_ + n0, count,
                    tile_.data() + (r + plan.grid - plan.most) % plan.grid * wideband_tile_row);
      transforms_.to_directions.run(tile_.data());
      const kernels::TimeFactor factor = factor_of(bend, q);
      for (std::size_t b = 0; b < plan.u_beam.size(); ++b)
        kernels::add_beam(plan.beam_weight.data() + b * width, plan.beam_row.data() + b * width, width,
                          reinterpret_cast<const float*>(tile_.data()), wideband_tile_row,
                          {factor.power + b, factor.powers, factor.stride}, time.data(), wideband_tile,
                          sums_.data() + 2 * b * wideband_tile);
    }
    for (std::size_t b = 0; b < plan.u_beam.size(); ++b) {
      double* sum = reinterpret_cast<double*>(&pressure(static_cast<Eigen::Index>(b), from));
      const float* part = sums_.data() + 2 * (b * wideband_tile + static_cast<std::size_t>(from - first));
      for (std::ptrdiff_t n = 0; n < 2 * (to - from); ++n) sum[n] += unit_ * static_cast<double>(part[n]);
    }
  }
}

}  // namespace insonify
