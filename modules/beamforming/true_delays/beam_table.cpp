#include <algorithm>
#include <cmath>
#include <numbers>

#include "beamforming/numerics/path_difference_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/true_delays/beam_table_internal.hpp"
#include "beamforming/true_delays/beam_table_loops_internal.hpp"
#include "beamforming/true_delays/node_functions_internal.hpp"

namespace insonify {
namespace {

using kernels::direction_taps;
using kernels::range_taps;
using kernels::time_taps;

constexpr std::size_t taps_before = 3;  // the interval that is interpolated
constexpr double farthest_ratio =
    1.4;  // of the ranges of a table: losses and pulses change with range, not with its inverse
// What polynomials through eight steps leave at the middle of the inner one, of a wave that turns by one radian per step.
constexpr double eight_left = 1.07e-3;
constexpr double four_left = 1.0 / 3072;  // the same of a cubic through Chebyshev nodes, by the phase over all of them

/// Weights of polynomial interpolation through eight even steps at `at` steps after the first.
void eight_weights(double at, float* weight) {
  static constexpr double per[8] = {-1.0 / 5040, 1.0 / 720, -1.0 / 240, 1.0 / 144,
                                    -1.0 / 144,  1.0 / 240, -1.0 / 720, 1.0 / 5040};
  for (std::size_t k = 0; k < 8; ++k) {
    double product = per[k];
    for (std::size_t j = 0; j < 8; ++j)
      if (j != k) product *= at - static_cast<double>(j);
    weight[k] = static_cast<float>(product);
  }
}

/// Steps of the table per step of the sampling theorem, for the highest frequency of a Gaussian pulse's band: errors count by
/// its spectrum, which has fallen to the tolerance there.
double finer_in_time(double tolerance) {
  const double fall = -std::log(tolerance), weight = std::pow(4 / fall, 4) * std::exp(-4.0);
  return std::max(1.5, pi * std::pow(eight_left * weight / (0.1 * tolerance), 1.0 / 8));
}

/// The same for the elements at the ends of the array, which have a small part of its weight.
double finer_in_direction(double tolerance) {
  constexpr double weight = 0.04;
  return std::max(1.5, pi * std::pow(eight_left * weight / (0.2 * tolerance), 1.0 / 8));
}

double half_band_of(const Pulse& pulse, double tolerance) {
  return pulse.bandwidth * (0.03 + std::sqrt(-std::log(tolerance) / (2 * std::numbers::ln2)));
}

bool is_symmetric(const std::vector<double>& w) {
  for (std::size_t m = 0; m < w.size() / 2; ++m)
    if (std::abs(w[m] - w[w.size() - 1 - m]) > 1e-12 * std::abs(w[m])) return false;
  return true;
}

/// 1 for x <= 0 and 0 for x >= 1, as smooth as an integral of a Kaiser window.
double faded(double x) {
  constexpr int steps = 64;
  constexpr double beta = 13;
  if (x <= 0 || x >= 1) return x <= 0;
  const auto area = [](double to) {
    double sum = 0;  // the midpoint rule: the integrand is smooth
    for (int k = 0; k < steps; ++k) {
      const double z = 2 * to * (k + 0.5) / steps - 1;
      sum += std::cyl_bessel_i(0, beta * std::sqrt(std::max(0.0, 1 - z * z)));
    }
    return to * sum / steps;
  };
  return area(1 - x) / area(1);
}

std::size_t filled_up(std::size_t bins) {
  constexpr std::size_t at_once = kernels::numbers_at_once / 2;
  return (bins + at_once - 1) / at_once * at_once;
}

}  // namespace

ArrayPart ArrayPart::whole(const LineArray& array) {
  ArrayPart part;
  for (std::size_t m = 0; m < array.elements(); ++m) {
    part.y.push_back(array.spacing * element_place(m, array.elements()));
    part.weight.push_back(array.shading[m] / static_cast<double>(array.elements()));
  }
  return part;
}

ArrayPart ArrayPart::end(const LineArray& array, double fade) {
  const ArrayPart all = whole(array);
  ArrayPart part;
  part.centre = all.y.back(), part.fade = fade;
  for (std::size_t m = 0; m < all.y.size(); ++m)
    if (const double left = faded((part.centre - all.y[m]) / fade); left > 0) {
      part.y.push_back(all.y[m]);
      part.weight.push_back(left * all.weight[m]);
    }
  return part;
}

BeamTableSizes::BeamTableSizes(const SonarHead& head_in, const Medium& medium_in, double tolerance_in, double widest_in,
                               ArrayPart part_in)
    : head(head_in),
      medium(medium_in),
      tolerance(tolerance_in),
      widest(widest_in),
      part(std::move(part_in)),
      axis(head.gate, medium.sound_speed),
      reach(head.pulse, medium.absorption, medium.sound_speed, false, pulse_cut(tolerance)),
      shapes(head.pulse, medium),
      u_beam(beam_cosines(head.fan).front()),
      mirrored(part.fade == 0 && std::abs(u_beam) < 1e-12 && is_symmetric(part.weight)) {
  const double half_band = half_band_of(head.pulse, tolerance);
  highest = head.pulse.centre_frequency + half_band;
  // Steps of the sampling theorem: elements of an end lie to one side of its centre, and fade.
  const double per_u =
      highest / medium.sound_speed * (part.fade > 0 ? 0.65 * part.fade : part.y.back() - part.y.front());
  u_step = std::min(0.25 * widest, 1 / (per_u * finer_in_direction(tolerance)));
  const double farthest = (1 + 2 * most_shifted) * widest;
  first_u = -(mirrored ? 0 : farthest) - taps_before * u_step;
  directions = static_cast<std::size_t>(std::ceil((farthest - first_u) / u_step)) + direction_taps;
  // Focusing at every range moves the frequencies of the outermost elements.
  per_bin = static_cast<std::size_t>(std::ceil(axis.step * 2 * 1.3 * half_band * finer_in_time(tolerance)));
}

double BeamTableSizes::lateness(double range, double u) const {
  return (path_difference(range, u, part.centre) - path_difference(range, u_beam, part.centre)) / medium.sound_speed;
}

/// By how much later than at the centre of the part an echo counts at y, `time` after it [m].
double BeamTableSizes::path(double range, double u, double time, double y) const {
  const double c = medium.sound_speed, focus = std::max(range + 0.5 * c * time, 1e-3);
  return path_difference(range, u, y) - path_difference(focus, u_beam, y) - c * lateness(range, u);
}

double BeamTableSizes::half_length(double near, double far) const {
  const double c = medium.sound_speed, pulse = reach.at(2 * far / c);
  double half = pulse;
  // Later responses are focused elsewhere. Of a part that fades, all but the end cancels.
  for (int pass = 0; pass < 3; ++pass) {
    double most = 0;
    for (const double y : {part.fade > 0 ? part.centre : part.y.front(), part.y.back()})
      for (const double u : {-widest, 0.0, widest})
        for (const double late : {-half, half})
          most = std::max(most, std::abs(path(near, u, late + lateness(near, u), y)));
    half = pulse + 1.02 * most / c;
  }
  return half;
}

double BeamTableSizes::phase_between(double near, double far) const {
  double most = 0;
  for (const double y : {part.fade > 0 ? part.centre - 0.1 * part.fade : part.y.front(), part.y.back()})
    for (const double u : {-widest, -0.5 * widest, 0.0, 0.5 * widest, widest})
      for (const double late : {-reach.half, reach.half})
        most = std::max(
            most, std::abs(path(near, u, late + lateness(near, u), y) - path(far, u, late + lateness(far, u), y)));
  return 2 * pi * highest / medium.sound_speed * most;
}

double BeamTableSizes::last_bin(double first) const {
  constexpr double weight = 0.02;  // of the outermost elements, at the ends of the pulse
  const double allowed = std::pow(0.2 * tolerance / (four_left * weight), 0.25), near = range_of(first);
  double length = 8;
  const auto fits = [&](double bins) {
    const double far = range_of(first + bins);
    return far <= farthest_ratio * near && phase_between(near, far) <= allowed;
  };
  while (fits(1.25 * length)) length *= 1.25;
  return first + std::floor(length);
}

double BeamTable::guard(const BeamTableSizes& sizes, double first_bin, double last_bin) {
  return std::ceil(sizes.half_length(sizes.range_of(first_bin), sizes.range_of(last_bin)) / sizes.axis.step) + 1;
}

double BeamTable::work(const BeamTableSizes& sizes, double last_bin) {
  const double samples = 2 * sizes.reach.at(2 * sizes.range_of(last_bin) / sizes.medium.sound_speed) *
                         static_cast<double>(sizes.per_bin) / sizes.axis.step;
  return static_cast<double>(range_taps * sizes.directions * sizes.part.y.size()) * samples;
}

double BeamTable::bytes(const BeamTableSizes& sizes, double first_bin, double last_bin) {
  const auto width = filled_up(static_cast<std::size_t>(2 * guard(sizes, first_bin, last_bin)));
  return static_cast<double>(range_taps * sizes.directions * (sizes.per_bin + time_taps) * 2 * width * sizeof(float));
}

BeamTable::BeamTable(const BeamTableSizes& sizes, double first_bin, double last_bin, double doppler)
    : sizes_(sizes),
      stretch_(1 + doppler),
      // A bin more at either end: delays are rounded.
      half_(sizes.half_length(sizes.range_of(first_bin - 1), sizes.range_of(last_bin + 1))),
      width_(filled_up(static_cast<std::size_t>(2 * half_ / sizes.axis.step) + 1)),
      times_(sizes.per_bin + time_taps - 1),
      values_(range_taps * sizes.directions * times_ * 2 * width_) {
  const double near = 1 / sizes.range_of(first_bin - 1), far = 1 / sizes.range_of(last_bin + 1);
  for (std::size_t c = 0; c < range_taps; ++c)
    node_.push_back(0.5 * (near + far) + 0.5 * (near - far) * chebyshev_node(c, range_taps));
  for (std::size_t c = 0; c < range_taps; ++c) fill(c);
}

void BeamTable::fill(std::size_t node) {
  const BeamTableSizes& of = sizes_;
  const double c = of.medium.sound_speed, range = 1 / node_[node],
               step = of.axis.step / static_cast<double>(of.per_bin);
  const double start = -half_ - taps_before * step, reach = of.reach.at(2 * range / c);
  const EchoEnvelope envelope = of.shapes.of(2 * range / c);
  const std::size_t samples = width_ * of.per_bin + time_taps - 1;
  std::vector<double> focus(samples), re(of.directions * samples), im(of.directions * samples);
  for (std::size_t m = 0; m < of.part.y.size(); ++m)
    for (std::size_t g = 0; g < of.directions; ++g) {
      const double asked = of.first_u + static_cast<double>(g) * of.u_step,
                   u = std::clamp(of.u_beam + (asked - of.u_beam) / stretch_, -1.0, 1.0);
      const double late = of.lateness(range, u), path = path_difference(range, u, of.part.y[m]);
      if (g == 0 || of.part.fade > 0)
        kernels::focus_at({range + 0.5 * c * (start + late), 0.5 * c * step, of.u_beam, of.part.y[m]}, samples,
                          focus.data());
      // Samples that the pulse reaches.
      const auto [least, most] = std::minmax(focus[0], focus[samples - 1]);
      const double low = (-reach - late - (most - path) / c - start) / step,
                   high = (reach - late - (least - path) / c - start) / step;
      const double end = std::min(high + 2, static_cast<double>(samples));
      if (end > std::max(low, 0.0))
        kernels::add_element({start, step, late, stretch_ * of.head.pulse.centre_frequency, c, envelope.a, envelope.b},
                             focus.data(), path, of.part.weight[m], static_cast<std::size_t>(std::max(low, 0.0)),
                             static_cast<std::size_t>(end), re.data() + g * samples,
                             im.data() + g * samples);  // (E134)
    }
  for (std::size_t g = 0; g < of.directions; ++g)
    write(node, g, re.data() + g * samples, im.data() + g * samples);  // (E134)
}

void BeamTable::write(std::size_t node, std::size_t direction, const double* re, const double* im) {
  float* row = values_.data() + (node * sizes_.directions + direction) * times_ * 2 * width_;
  for (std::size_t q = 0; q < times_; ++q, row += 2 * width_)
    for (std::size_t n = 0; n < width_; ++n) {
      row[2 * n] = static_cast<float>(re[q + n * sizes_.per_bin]);
      row[2 * n + 1] = static_cast<float>(im[q + n * sizes_.per_bin]);
    }
}

void BeamTable::add(double delay, double u, std::complex<double> amplitude, double doppler, const BeamTable* shifted,
                    std::ptrdiff_t first, std::ptrdiff_t bins, std::complex<double>* image) const {
  const BeamTableSizes& of = sizes_;
  const double carrier = of.head.pulse.centre_frequency, stretch = 1 + doppler / carrier;
  kernels::ResponseTaps taps;
  taps.row = 2 * width_, taps.line = times_ * taps.row, taps.plane = of.directions * taps.line;
  // Between ranges.
  const double x = 2 / (of.medium.sound_speed * delay);
  for (std::size_t c = 0; c < range_taps; ++c) {
    double weight = 1;
    for (std::size_t k = 0; k < range_taps; ++k)
      if (k != c) weight *= (x - node_[k]) / (node_[c] - node_[k]);
    taps.range[c] = static_cast<float>(weight);
  }
  // Between directions.
  const double asked = of.u_beam + stretch * ((of.mirrored ? std::abs(u) : u) - of.u_beam);
  const double place = (asked - of.first_u) / of.u_step;
  const auto direction = static_cast<std::size_t>(place) - taps_before;
  eight_weights(place - static_cast<double>(direction), taps.direction);
  // Between times: the first bin that the response reaches, and where in a bin the echo lies.
  const double late = of.part.fade > 0 ? of.lateness(1 / x, u) : 0, half_bins = half_ / of.axis.step;
  const double bin = (delay + late - of.axis.start) / of.axis.step, from = std::ceil(bin - half_bins);
  const double time = std::clamp(from - bin + half_bins, 0.0, 1 - 1e-12) * static_cast<double>(of.per_bin);
  const auto within = static_cast<std::size_t>(time);
  eight_weights(time - static_cast<double>(within) + taps_before, taps.time);

  // Bins of the response and of the image.
  const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(from) - first;
  const auto begin = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, -at)),
             end = static_cast<std::size_t>(
                 std::clamp<std::ptrdiff_t>(bins - at, 0, static_cast<std::ptrdiff_t>(width_)));
  amplitude *= of.shapes.of(delay).gain;
  if (late != 0) amplitude *= std::polar(1.0, 2 * pi * reduced_cycles(stretch * carrier * late));
  thread_local std::vector<float> response, other;
  response.resize(taps.row);
  const std::size_t origin = direction * taps.line + within * taps.row;
  kernels::sum_response(values_.data() + origin, taps, response.data());
  if (!shifted) {
    for (std::size_t n = begin; n < end; ++n)
      image[at + static_cast<std::ptrdiff_t>(n)] +=
          amplitude * std::complex<double>(response[2 * n], response[2 * n + 1]);
    return;
  }
  // A line through both tables, and the shift itself since the echo's delay.
  other.resize(taps.row);
  kernels::sum_response(shifted->values_.data() + origin, taps, other.data());
  const double part = doppler / (BeamTableSizes::shifted * carrier);
  const auto between = [&](std::size_t k) { return response[k] + part * (other[k] - response[k]); };
  const double since = (from + static_cast<double>(begin)) * of.axis.step + of.axis.start - delay;
  std::complex<double> turn = amplitude * std::polar(1.0, -2 * pi * reduced_cycles(doppler * since));
  const std::complex<double> turns = std::polar(1.0, -2 * pi * reduced_cycles(doppler * of.axis.step));
  for (std::size_t n = begin; n < end; ++n, turn *= turns)
    image[at + static_cast<std::ptrdiff_t>(n)] += turn * std::complex<double>(between(2 * n), between(2 * n + 1));
}

}  // namespace insonify
