// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "beamforming/numerics/path_difference_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/true_delays/beam_table_internal.hpp"
#include "beamforming/true_delays/beam_table_loops_internal.hpp"
#include "beamforming/true_delays/node_functions_internal.hpp"
#include "beamforming/true_delays/true_delay_plan_internal.hpp"

namespace insonify {
namespace {

using kernels::direction_taps;
using kernels::taps_before;

// Limits the farthest range of a table to this times the nearest: losses and pulses change with range, not with its
// inverse.
constexpr double farthest_ratio = 1.4;
// Tables of few ranges must be as long as this, so that they are few.
constexpr double enough_ratio = 1.2;
// Error of polynomials through eight steps at the middle of the inner one, for a wave that turns by one radian per
// step.
constexpr double eight_left = 1.07e-3;

/// Returns the steps of time per step of the sampling theorem, for the highest frequency of a Gaussian pulse's band:
/// errors count by its spectrum, which has fallen to the tolerance there.
double finer_in_time(double tolerance) {
  const double fall = -std::log(tolerance), weight = std::pow(4 / fall, 4) * std::exp(-4.0);
  return std::max(1.5, pi * std::pow(eight_left * weight / (0.1 * tolerance), 1.0 / 8));
}

/// Returns the steps of direction per step of the sampling theorem, for the elements at the ends of the array, which
/// have a small part of its weight.
double finer_in_direction(double tolerance) {
  constexpr double weight = 0.04;
  return std::max(1.5, pi * std::pow(eight_left * weight / (0.2 * tolerance), 1.0 / 8));
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

}  // namespace

ArraySection ArraySection::whole(const LineArray& array) {
  ArraySection section;
  for (std::size_t m = 0; m < array.elements(); ++m) {
    section.y.push_back(array.spacing * element_position(m, array.elements()));
    section.weight.push_back(array.shading[m] / static_cast<double>(array.elements()));
  }
  return section;
}

ArraySection ArraySection::end(const LineArray& array, double fade) {
  const ArraySection all = whole(array);
  ArraySection section;
  section.centre = all.y.back(), section.fade = fade;
  for (std::size_t m = 0; m < all.y.size(); ++m)
    if (const double left = faded((section.centre - all.y[m]) / fade); left > 0) {
      section.y.push_back(all.y[m]);
      section.weight.push_back(left * all.weight[m]);
    }
  return section;
}

BeamTableSizes::BeamTableSizes(const SonarHead& head_in, const Medium& medium_in, double tolerance_in, double widest_in,
                               ArraySection part_in)
    : head(head_in),
      medium(medium_in),
      tolerance(tolerance_in),
      widest(widest_in),
      section(std::move(part_in)),
      axis(head.gate, medium.sound_speed),
      reach(head.pulse, medium.absorption, medium.sound_speed, false, pulse_cut(tolerance)),
      shapes(head.pulse, medium),
      u_beam(beam_cosines(head.fan).front()),
      mirrored(section.fade == 0 && std::abs(u_beam) < 1e-12 && is_symmetric(section.weight)) {
  const double half_band = half_band_of(head.pulse, tolerance);
  highest = head.pulse.centre_frequency + half_band;
  // Steps of the sampling theorem: elements of an end lie to one side of its centre, and fade.
  const double per_u =
      highest / medium.sound_speed * (section.fade > 0 ? 0.65 * section.fade : section.y.back() - section.y.front());
  u_step = std::min(0.25 * widest, 1 / (per_u * finer_in_direction(tolerance)));
  // Focusing at every range moves the frequencies of the outermost elements.
  per_bin = static_cast<std::size_t>(std::ceil(axis.step * 2 * 1.3 * half_band * finer_in_time(tolerance)));
}

double BeamTableSizes::local(double range, double u) const {
  const double y = section.centre;
  return y == 0 ? u : (range * u - y) / (range + path_difference(range, u, y));
}

double BeamTableSizes::seen(double range, double u) const { return local(range, u) - local(range, u_beam); }

double BeamTableSizes::u_seen(double range, double w) const {
  const double here = w + local(range, u_beam), y = section.centre, across = y * (1 - here * here);
  return (across + here * std::sqrt(std::max(0.0, range * range - y * across))) / range;
}

std::array<double, 2> BeamTableSizes::extent(double near, double far) const {
  std::array<double, 2> all = {0, 0};
  for (const double range : {near, far})
    for (const double u : {-widest, widest}) {
      all[0] = std::min(all[0], seen(range, u));
      all[1] = std::max(all[1], seen(range, u));
    }
  return all;
}

BeamTableSizes::Directions BeamTableSizes::directions_of(const Span& span) const {
  const auto [least, most] = extent(range_of(span.first - 1), range_of(span.last + 1));
  const double moved = 2 * most_shifted * std::max(-least, most);
  const double first = (mirrored ? 0 : least - moved) - static_cast<double>(taps_before) * u_step;
  return {first, static_cast<std::size_t>(std::ceil((most + moved - first) / u_step)) + direction_taps};
}

double BeamTableSizes::lateness(double range, double u) const {
  return (path_difference(range, u, section.centre) - path_difference(range, u_beam, section.centre)) /
         medium.sound_speed;
}

/// Returns the path [m] by which an echo counts later at y than at the centre of the part, `time` [s] after it.
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
    for (const double y : {section.fade > 0 ? section.centre : section.y.front(), section.y.back()})
      for (const double u : {-widest, 0.0, widest})
        for (const double late : {-half, half})
          most = std::max(most, std::abs(path(near, u, late + lateness(near, u), y)));
    half = pulse + 1.02 * most / c;
  }
  return half;
}

double BeamTableSizes::left_of(const Span& span) const {
  constexpr double weight = 0.02;  // of the outermost elements, at the ends of the pulse
  const double first = range_of(span.first), last = range_of(span.last);
  const double near = span.position(first), far = span.position(last);
  // Errors are largest where a Chebyshev polynomial is.
  const auto count = static_cast<Eigen::Index>(span.nodes);
  const Eigen::VectorXd checks =
      (Eigen::VectorXd::LinSpaced(count + 1, 0, static_cast<double>(count)) * pi / static_cast<double>(count))
          .array()
          .cos();
  const Eigen::VectorXd nodes = chebyshev_points(span.nodes);
  const Eigen::MatrixXd between = from_nodes(checks, span.nodes);
  const auto left = [&](const auto& response) {
    const auto at = [&](double x) -> std::complex<double> {
      return response(span.range_at(0.5 * (near + far) + 0.5 * (near - far) * x));
    };
    return (checks.unaryExpr(at) - between * nodes.unaryExpr(at)).cwiseAbs().maxCoeff();
  };
  const auto [least, most] = extent(first, last);
  double phases = 0, pulses = 0;
  for (const double y : {section.fade > 0 ? section.centre - 0.15 * section.fade : section.y.front(), section.y.back()})
    for (const double w : {least, 0.5 * least, 0.0, 0.5 * most, most})
      for (const double late : {-reach.half, reach.half})
        phases = std::max(phases, left([&](double range) {
                            const double u = u_seen(range, w);
                            const double detour = path(range, u, late + lateness(range, u), y);
                            return std::polar(1.0, 2 * pi * highest / medium.sound_speed * detour);
                          }));
  const double width = std::sqrt(shapes.of(2 * last / medium.sound_speed).a) / pi;  // to where a pulse falls by e
  for (const double t : {-1.5 * width, -0.7 * width, 0.7 * width, 1.5 * width})
    pulses = std::max(pulses, left([&](double range) {
                        const EchoEnvelope envelope = shapes.of(2 * range / medium.sound_speed);
                        return envelope.at(t) / envelope.gain;
                      }));
  return weight * phases + pulses;
}

BeamTableSizes::Span BeamTableSizes::longest_span(double first, std::size_t nodes, bool by_inverse) const {
  Span span{first, first + 8, nodes, by_inverse};
  for (double length = 8;; span.last = first + std::floor(length)) {
    length *= 1.25;
    const Span longer{first, first + length, nodes, by_inverse};
    if (range_of(longer.last) > farthest_ratio * range_of(first) || left_of(longer) > 0.5 * tolerance) return span;
  }
}

BeamTableSizes::Span BeamTableSizes::span_from(double first) const {
  for (std::size_t nodes = 2; nodes < kernels::most_ranges; ++nodes)
    for (const bool by_inverse : {true, false})
      if (const Span span = longest_span(first, nodes, by_inverse);
          range_of(span.last) >= enough_ratio * range_of(first))
        return span;
  return longest_span(first, kernels::most_ranges, true);
}

}  // namespace insonify
