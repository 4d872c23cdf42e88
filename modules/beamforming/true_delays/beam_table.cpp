// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "beamforming/numerics/path_difference_internal.hpp"
#include "beamforming/true_delays/beam_table_internal.hpp"
#include "beamforming/true_delays/beam_table_loops_internal.hpp"
#include "beamforming/true_delays/node_functions_internal.hpp"

namespace insonify {
namespace {

using kernels::taps_before;
using kernels::time_taps;

/// Weights of polynomial interpolation through eight even steps at `at` steps after the first.
void eight_weights(double at, float* weight) {
  static constexpr double per[8] = {-1.0 / 5040, 1.0 / 720, -1.0 / 240, 1.0 / 144,
                                    -1.0 / 144,  1.0 / 240, -1.0 / 720, 1.0 / 5040};
  // Products of the distances to all steps before each, then of those after it.
  double before[8], after = 1;
  before[0] = 1;
  for (std::size_t k = 1; k < 8; ++k) before[k] = before[k - 1] * (at - static_cast<double>(k - 1));
  for (std::size_t k = 8; k-- > 0;) {
    weight[k] = static_cast<float>(per[k] * before[k] * after);
    after *= at - static_cast<double>(k);
  }
}

std::size_t filled_up(std::size_t bins) {
  constexpr std::size_t at_once = kernels::numbers_at_once / 2;
  return (bins + at_once - 1) / at_once * at_once;
}

}  // namespace

double BeamTable::guard(const BeamTableSizes& sizes, const BeamTableSizes::Span& span) {
  return std::ceil(sizes.half_length(sizes.range_of(span.first), sizes.range_of(span.last)) / sizes.axis.step) + 1;
}

double BeamTable::work(const BeamTableSizes& sizes, const BeamTableSizes::Span& span) {
  const double samples = 2 * sizes.reach.at(2 * sizes.range_of(span.last) / sizes.medium.sound_speed) *
                         static_cast<double>(sizes.per_bin) / sizes.axis.step;
  return static_cast<double>(span.nodes * sizes.directions_of(span).count * sizes.section.y.size()) * samples;
}

double BeamTable::bytes(const BeamTableSizes& sizes, const BeamTableSizes::Span& span) {
  const auto width = filled_up(static_cast<std::size_t>(2 * guard(sizes, span)));
  return static_cast<double>(span.nodes * sizes.directions_of(span).count * (sizes.per_bin + time_taps) * 2 * width *
                             sizeof(float));
}

BeamTable::BeamTable(const BeamTableSizes& sizes, const BeamTableSizes::Span& span, double doppler)
    : sizes_(sizes),
      stretch_(1 + doppler),
      // A bin more at either end: delays are rounded.
      half_(sizes.half_length(sizes.range_of(span.first - 1), sizes.range_of(span.last + 1))),
      width_(filled_up(static_cast<std::size_t>(2 * half_ / sizes.axis.step) + 1)),
      times_(sizes.per_bin + time_taps - 1),
      span_(span),
      directions_(sizes.directions_of(span)),
      values_(span.nodes * directions_.count * times_ * 2 * width_) {
  const double near = span.position(sizes.range_of(span.first - 1)), far = span.position(sizes.range_of(span.last + 1));
  for (std::size_t c = 0; c < span.nodes; ++c)
    node_.push_back(0.5 * (near + far) + 0.5 * (near - far) * chebyshev_node(c, span.nodes));
  for (std::size_t c = 0; c < span.nodes; ++c) {
    node_weight_.push_back(1);
    for (std::size_t k = 0; k < span.nodes; ++k)
      if (k != c) node_weight_[c] /= node_[c] - node_[k];
    fill(c);
  }
  find_bins();
}

void BeamTable::fill(std::size_t node) {
  const BeamTableSizes& of = sizes_;
  const double c = of.medium.sound_speed, range = span_.range_at(node_[node]),
               step = of.axis.step / static_cast<double>(of.per_bin);
  const double start = -half_ - taps_before * step, reach = of.reach.at(2 * range / c);
  const EchoEnvelope envelope = of.shapes.of(2 * range / c);
  const std::size_t samples = width_ * of.per_bin + time_taps - 1;
  std::vector<double> focus(samples), re(directions_.count * samples), im(directions_.count * samples);
  for (std::size_t m = 0; m < of.section.y.size(); ++m)
    for (std::size_t g = 0; g < directions_.count; ++g) {
      const double wanted = directions_.first + static_cast<double>(g) * of.u_step;
      const double u = of.u_seen(range, wanted / stretch_);
      const double late = of.lateness(range, u), path = path_difference(range, u, of.section.y[m]);
      if (g == 0 || of.section.fade > 0)
        kernels::focus_at({range + 0.5 * c * (start + late), 0.5 * c * step, of.u_beam, of.section.y[m]}, samples,
                          focus.data());
      const auto [least, most] = std::minmax(focus[0], focus[samples - 1]);
      const double low = (-reach - late - (most - path) / c - start) / step,
                   high = (reach - late - (least - path) / c - start) / step;
      const double end = std::min(high + 2, static_cast<double>(samples));
      if (end > std::max(low, 0.0))
        kernels::add_element({start, step, late, stretch_ * of.head.pulse.centre_frequency, c, envelope.a, envelope.b},
                             focus.data(), path, of.section.weight[m], static_cast<std::size_t>(std::max(low, 0.0)),
                             static_cast<std::size_t>(end), re.data() + g * samples,
                             im.data() + g * samples);  // (E134)
    }
  for (std::size_t g = 0; g < directions_.count; ++g) write(node, g, re.data() + g * samples, im.data() + g * samples);
}

void BeamTable::write(std::size_t node, std::size_t direction, const double* re, const double* im) {
  float* row = values_.data() + (node * directions_.count + direction) * times_ * 2 * width_;
  for (std::size_t q = 0; q < times_; ++q, row += 2 * width_)
    for (std::size_t n = 0; n < width_; ++n) {
      row[2 * n] = static_cast<float>(re[q + n * sizes_.per_bin]);
      row[2 * n + 1] = static_cast<float>(im[q + n * sizes_.per_bin]);
    }
}

void BeamTable::find_bins() {
  constexpr std::size_t at_once = kernels::numbers_at_once / 2, taps = kernels::direction_taps;
  bins_.assign(directions_.count - taps + 1, {width_, 0});
  const float* row = values_.data();
  for (std::size_t c = 0; c < node_.size(); ++c)
    for (std::size_t g = 0; g < directions_.count; ++g)
      for (std::size_t n = 0; n < times_ * width_; ++n, row += 2) {
        if (row[0] == 0 && row[1] == 0) continue;
        const std::size_t first = n % width_ / at_once * at_once;
        for (std::size_t k = g < taps ? 0 : g - taps + 1; k <= std::min(g, bins_.size() - 1); ++k)
          bins_[k] = {std::min(bins_[k].first, first), std::max(bins_[k].last, first + at_once)};
      }
  for (Bins& bins : bins_) bins.first = std::min(bins.first, bins.last);
}

void BeamTable::add(double delay, double u, std::complex<double> amplitude, double doppler, const BeamTable* shifted,
                    std::ptrdiff_t first, std::ptrdiff_t bins, std::complex<double>* image) const {
  const BeamTableSizes& of = sizes_;
  const double carrier = of.head.pulse.centre_frequency, stretch = 1 + doppler / carrier;
  kernels::ResponseTaps taps;
  taps.row = 2 * width_, taps.line = times_ * taps.row, taps.plane = directions_.count * taps.line;
  const double range = 0.5 * of.medium.sound_speed * delay, x = span_.position(range);
  taps.ranges = node_.size();
  for (std::size_t c = 0; c < node_.size(); ++c) {
    double weight = node_weight_[c];
    for (std::size_t k = 0; k < node_.size(); ++k)
      if (k != c) weight *= x - node_[k];
    taps.range[c] = static_cast<float>(weight);
  }
  const double wanted = stretch * of.seen(range, of.mirrored ? std::abs(u) : u);
  const double position = (wanted - directions_.first) / of.u_step;
  const auto direction = static_cast<std::size_t>(position) - taps_before;
  eight_weights(position - static_cast<double>(direction), taps.direction);
  // Between times: the first bin that the response reaches, and where in a bin the echo lies.
  const double late = of.section.fade > 0 ? of.lateness(range, u) : 0, half_bins = half_ / of.axis.step;
  const double bin = (delay + late - of.axis.start) / of.axis.step, from = std::ceil(bin - half_bins);
  const double time = std::clamp(from - bin + half_bins, 0.0, 1 - 1e-12) * static_cast<double>(of.per_bin);
  const auto within = static_cast<std::size_t>(time);
  eight_weights(time - static_cast<double>(within) + taps_before, taps.time);

  // Bins of the response and of the image.
  const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(from) - first;
  Bins some = bins_[direction];
  if (shifted) {
    some.first = std::min(some.first, shifted->bins_[direction].first);
    some.last = std::max(some.last, shifted->bins_[direction].last);
  }
  const auto begin = std::max(some.first, static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, -at))),
             end = std::min(some.last, static_cast<std::size_t>(std::max<std::ptrdiff_t>(bins - at, 0)));
  taps.eights = (some.last - some.first) * 2 / kernels::numbers_at_once;
  amplitude *= of.shapes.of(delay).gain;
  if (late != 0) amplitude *= std::polar(1.0, 2 * pi * reduced_cycles(stretch * carrier * late));
  thread_local std::vector<float> response, other;
  response.resize(taps.row);
  const std::size_t origin = direction * taps.line + within * taps.row + 2 * some.first;
  kernels::sum_response(values_.data() + origin, taps, response.data() + 2 * some.first);
  if (!shifted) {
    for (std::size_t n = begin; n < end; ++n)
      image[at + static_cast<std::ptrdiff_t>(n)] +=
          amplitude * std::complex<double>(response[2 * n], response[2 * n + 1]);
    return;
  }
  // A line through both tables, and the shift itself since the echo's delay.
  other.resize(taps.row);
  kernels::sum_response(shifted->values_.data() + origin, taps, other.data() + 2 * some.first);
  const double section = doppler / (BeamTableSizes::shifted * carrier);
  const auto between = [&](std::size_t k) { return response[k] + section * (other[k] - response[k]); };
  const double since = (from + static_cast<double>(begin)) * of.axis.step + of.axis.start - delay;
  std::complex<double> turn = amplitude * std::polar(1.0, -2 * pi * reduced_cycles(doppler * since));
  const std::complex<double> turns = std::polar(1.0, -2 * pi * reduced_cycles(doppler * of.axis.step));
  for (std::size_t n = begin; n < end; ++n, turn *= turns)
    image[at + static_cast<std::ptrdiff_t>(n)] += turn * std::complex<double>(between(2 * n), between(2 * n + 1));
}

}  // namespace insonify
