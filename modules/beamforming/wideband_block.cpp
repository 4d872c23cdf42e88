#include <algorithm>
#include <array>
#include <cmath>

#include "beamforming/wideband_block_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using kernels::lines_at_once;

constexpr std::size_t chunk_row = 2 * lines_at_once;  // numbers of a harmonic, or element, in a chunk of frequencies
constexpr std::size_t elements_at_once = 64;          // whose taps stay in the cache from term to term

kernels::TimeFactor factor_of(const BendSeries& bend, std::size_t term) {
  return {bend.along.data() + term * bend.powers * 2 * bend.stride, bend.powers, bend.stride};
}

/// A time within the block, from -1 to 1.
float place_in(const BendSeries& bend, double time) {
  return static_cast<float>(std::clamp((time - bend.middle) / bend.half, -1.0, 1.0));
}

}  // namespace

WidebandTransforms::WidebandTransforms(const WidebandPlan& plan)
    : to_harmonics(plan.grid, wideband_tile, plan.grid_stride, FFTW_FORWARD),
      to_frequencies(plan.fine, 1, plan.fine, FFTW_FORWARD),
      to_directions(plan.grid, wideband_tile, wideband_tile_row, FFTW_BACKWARD),
      to_bins(plan.cycle, 1, FFTW_BACKWARD) {}

WidebandRoom::WidebandRoom(const WidebandPlan& plan, const WidebandTransforms& transforms)
    : plan_(plan),
      transforms_(transforms),
      re_((plan.fine + wideband_tile) * plan.grid_stride),
      im_((plan.fine + wideband_tile) * plan.grid_stride),
      tile_(plan.grid_stride * wideband_tile_row),
      harmonics_(plan.grid_stride * wideband_tile),
      spectrum_(plan.rows() * plan.fine_row),
      row_(plan.fine),
      elements_(plan.chunks.size() * plan.elements() * chunk_row),
      line_(lines_at_once),
      scratch_(std::max<std::size_t>(plan.pulse.lanes, 8)),
      sums_(plan.u_beam.size() * 2 * wideband_tile),
      touched_(plan.fine / wideband_tile + 2),
      bins_row_((plan.cycle + 15) / 8 * 8) {}

WidebandBlock::WidebandBlock(const WidebandPlan& plan, double first_in, double last_in)
    : first(first_in), last(last_in) {
  const auto guard = static_cast<double>(plan.guard), bins = static_cast<double>(plan.axis.bins);
  received = bend_of_echoes(plan, plan.time_of(first) - plan.reach, plan.time_of(last) + plan.reach);
  undone = bend_of_beams(plan, plan.time_of(std::max(first - guard, 0.0)), plan.time_of(std::min(last + guard, bins)));
}

void WidebandRoom::make_room(std::size_t terms) {
  const std::size_t elements = plan_.elements(),
                    room = std::max(plan_.rows() * bins_row_, plan_.chunks.size() * plan_.rows() * lines_at_once);
  while (term_.size() < terms) term_.push_back(std::make_unique<Spectrum>(room));
  chunk_.resize(std::max(chunk_.size(), terms * plan_.rows() * chunk_row));
  start_.resize(std::max(start_.size(), terms * 2 * elements));
  step_.resize(std::max(step_.size(), terms * chunk_row * elements));
}

void WidebandRoom::add_image(const WidebandBlock& block, ComplexGrid& pressure) {
  if (unit_ == 0) return;
  make_room(std::max(block.received.terms, block.undone.terms));
  for (std::size_t q = 0; q < block.received.terms; ++q)
    receive_term(block.received, q, reinterpret_cast<float*>(term_[q]->data()));
  gather_elements(block.received);
  form_beam_terms(block.undone);
  add_beams(block, pressure);
}

template <typename Visit, typename Done>
void WidebandRoom::each_chunk(const BendSeries& bend, Visit&& visit, Done&& done) {
  const WidebandPlan& plan = plan_;
  const std::size_t elements = plan.elements(), all = bend.terms * elements;
  // exp(2 pi i F delay), F = f_c - line / seconds: from chunk to chunk by a factor, away from the carrier.
  carrier_.resize(all);
  turn_.resize(all);
  for (std::size_t m = 0; m < all; ++m) {
    const double cycles = plan.head.pulse.centre_frequency * bend.delay[m], each = -bend.delay[m] / plan.seconds();
    carrier_[m] = std::polar(1.0, 2 * pi * (cycles - std::floor(cycles)));
    turn_[m] = std::polar(1.0, 2 * pi * each * static_cast<double>(lines_at_once));
    const std::complex<double> one = std::polar(1.0, 2 * pi * each);
    std::complex<double> power = 1;
    for (std::size_t l = 0; l < lines_at_once; ++l, power *= one) {
      step_[m * chunk_row + l] = static_cast<float>(power.real());
      step_[m * chunk_row + lines_at_once + l] = static_cast<float>(power.imag());
    }
  }
  const auto one_chunk = [&](std::size_t i) {
    const std::size_t line = plan.chunks[i] * lines_at_once;
    for (std::size_t l = 0; l < lines_at_once; ++l)
      line_[l] = static_cast<float>(plan.line_of(line + l) / (plan.seconds() * plan.half_band));
    for (std::size_t m = 0; m < all; ++m) {
      start_[2 * m] = static_cast<float>(now_[m].real());
      start_[2 * m + 1] = static_cast<float>(now_[m].imag());
    }
    for (std::size_t m = 0; m < elements; m += elements_at_once)
      for (std::size_t q = 0; q < bend.terms; ++q) {
        const std::size_t at = q * elements + m, tap = i * elements + m;
        const kernels::ElementTaps taps{std::min(elements_at_once, elements - m), plan.taps, plan.tap_row.data() + tap,
                                        plan.tap_weight.data() + tap * plan.taps * lines_at_once};
        const float* rest = bend.rest.empty() ? nullptr : bend.rest.data() + at * 2 * bend.rest_powers;
        const kernels::ElementTurns turns{start_.data() + 2 * at, step_.data() + at * chunk_row, rest, bend.rest_powers,
                                          line_.data()};
        visit(i, q, taps, turns, elements_.data() + tap * chunk_row);
      }
    done(i);
  };
  now_ = carrier_;
  std::size_t i = 0;
  for (; i < plan.chunks.size() && 2 * plan.chunks[i] * lines_at_once < plan.fine; ++i) {
    one_chunk(i);
    for (std::size_t m = 0; m < all; ++m) now_[m] *= turn_[m];
  }
  now_ = carrier_;
  for (std::size_t back = plan.chunks.size(); back-- > i;) {
    for (std::size_t m = 0; m < all; ++m) now_[m] *= std::conj(turn_[m]);
    one_chunk(back);
  }
}

void WidebandRoom::receive_term(const BendSeries& bend, std::size_t term, float* lines) {
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
      const double time = start_time_ + static_cast<double>(n0 + n) * plan.fine_step;
      kernels::weigh_row(factor, place_in(bend, time), re_.data() + (n0 + n) * plan.grid_stride,
                         im_.data() + (n0 + n) * plan.grid_stride, plan.grid,
                         reinterpret_cast<float*>(tile_.data() + n * plan.grid_stride));
    }
    transforms_.to_harmonics.run(tile_.data(), harmonics_.data());
    // One row per harmonic now; directions are counted from the middle of the period.
    for (std::size_t r = 0; r < plan.rows(); ++r) {
      const Complex* from = harmonics_.data() + (r + plan.grid - plan.most) % plan.grid;
      Complex* to = spectrum_.data() + r * plan.fine_row + n0;
      const float sign = (r + plan.most) % 2 == 0 ? 1.0F : -1.0F;
      for (std::size_t n = 0; n < count; ++n) to[n] = sign * from[n * plan.grid_stride];
    }
  }
  for (std::size_t r = 0; r < plan.rows(); ++r) {
    transforms_.to_frequencies.run(spectrum_.data() + r * plan.fine_row, row_.data());
    kernels::split_chunks(reinterpret_cast<const float*>(row_.data()), plan.chunks.data(), plan.chunks.size(),
                          lines + r * chunk_row, plan.rows() * chunk_row);
  }
}

void WidebandRoom::gather_elements(const BendSeries& bend) {
  const WidebandPlan& plan = plan_;
  const std::size_t chunk = plan.rows() * chunk_row, elements = plan.elements();
  std::fill(elements_.begin(), elements_.end(), 0.0F);
  each_chunk(
      bend,
      [&](std::size_t i, std::size_t q, const auto& taps, const auto& turns, float* x) {
        kernels::gather_elements(taps, turns, reinterpret_cast<const float*>(term_[q]->data()) + i * chunk, x);
      },
      [&](std::size_t i) {
        const float* weight = plan.element_weight.data() + i * elements * lines_at_once;
        float* x = elements_.data() + i * elements * chunk_row;
        for (std::size_t m = 0; m < elements; ++m, weight += lines_at_once, x += chunk_row)
          for (std::size_t l = 0; l < lines_at_once; ++l) x[l] *= weight[l], x[lines_at_once + l] *= weight[l];
      });
}

void WidebandRoom::form_beam_terms(const BendSeries& bend) {
  const WidebandPlan& plan = plan_;
  const std::size_t chunk = plan.rows() * chunk_row;
  const auto cycle = static_cast<std::ptrdiff_t>(plan.cycle);
  for (std::size_t q = 0; q < bend.terms; ++q) std::fill_n(term_[q]->data(), plan.rows() * bins_row_, Complex(0));
  std::fill_n(chunk_.begin(), bend.terms * chunk, 0.0F);
  each_chunk(
      bend,
      [&](std::size_t, std::size_t q, const auto& taps, const auto& turns, const float* x) {
        kernels::scatter_elements(taps, turns, x, chunk_.data() + q * chunk);
      },
      [&](std::size_t i) {
        // Frequencies beyond what bins can tell fold, as they do in any sampled image.
        const std::ptrdiff_t line =
            static_cast<std::ptrdiff_t>(plan.line_of((plan.chunks[i] + 1) * lines_at_once - 1)) -
            static_cast<std::ptrdiff_t>(lines_at_once - 1);
        const std::ptrdiff_t bin = (line % cycle + cycle) % cycle;
        for (std::size_t q = 0; q < bend.terms; ++q)
          kernels::add_chunk(chunk_.data() + q * chunk, plan.row_factor.data(), plan.rows(),
                             reinterpret_cast<float*>(term_[q]->data() + bin), bins_row_);
        std::fill_n(chunk_.begin(), bend.terms * chunk, 0.0F);
      });
  for (std::size_t q = 0; q < bend.terms; ++q)
    for (std::size_t r = 0; r < plan.rows(); ++r) {
      Complex* bin = term_[q]->data() + r * bins_row_;
      for (std::size_t k = 0; k < lines_at_once; ++k) bin[k] += bin[plan.cycle + k];
      transforms_.to_bins.run(bin);
    }
}

void WidebandRoom::add_beams(const WidebandBlock& block, ComplexGrid& pressure) {
  const WidebandPlan& plan = plan_;
  const BendSeries& bend = block.undone;
  const std::size_t width = plan.kernel.width();
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
        std::copy_n(term_[q]->data() + r * bins_row_ + n0, count,
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
