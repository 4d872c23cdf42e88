// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "beamforming/true_delays/curvature_samples_internal.hpp"
#include "beamforming/true_delays/node_functions_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Complex = std::complex<double>;
constexpr double node_share = 0.05;  // of the tolerance, for nodes in range
constexpr double row_share = 0.01;   // of the tolerance, for what rows of harmonics undo
constexpr double nothing = 1e-20;    // square of a part of a series that does not count

/// b, and its derivatives by u and r.
struct Curvature {
  double b, by_u, by_u2, by_r, by_r2, by_ur;

  Curvature(double r, double u, double y) {
    const double there = std::sqrt(std::max(r * r - 2 * r * u * y + y * y, 1e-12 + 1e-6 * y * y));  // (E61)
    const double extra = (y * y - 2 * r * u * y) / (there + r);
    b = (y * y + y * u * extra) / (there + r);
    by_u = y - r * y / there;
    by_u2 = -r * r * y * y / (there * there * there);
    const double slope = (r - u * y) / there;
    by_r = slope - 1;
    by_r2 = (1 - slope * slope) / there;
    by_ur = (r * slope / there - 1) * y / there;
  }
};

/// Mean of the curvature to either side.
double mean_curvature(const CurvatureSpan& span, double y) {
  return 0.5 * (Curvature(span.mean_range, span.mean_u, y).b + Curvature(span.mean_range, -span.mean_u, y).b);
}

/// exp(i phase), and what undoes gridding beside it: the kernel of directions, around which the phase is a parabola,
/// and of echoes the time of their pulses.
Complex undone(const TrueDelayPlan& plan, const Curvature& curvature, double phase, double off,
               const std::vector<Complex>& moment, bool echoes) {
  const double wave = 2 * pi * (plan.head.pulse.centre_frequency - off) / plan.medium.sound_speed;
  const double step = plan.period / static_cast<double>(plan.grid);
  const Complex a = Complex(0, step * wave * curvature.by_u), b = Complex(0, step * step * wave * curvature.by_u2);
  Complex before = 1, now = a, sum = 1, slope = 0;
  double last = 1;
  for (std::size_t j = 1; j < TrueDelayPlan::moments; ++j) {
    const Complex share = now * moment[j];
    sum += share;
    slope += static_cast<double>(j) * before * moment[j];
    const double size = std::norm(share);
    if (std::max(size, last) < nothing) break;  // every other one may be 0
    last = size;
    const Complex next = a * now + static_cast<double>(j) * b * before;
    before = now;
    now = next;
  }
  if (!echoes) return std::polar(1.0, phase) * sum;
  // A Gaussian pulse whose samples are turned by a phase that grows with time: its spectrum is moved. Then what is of
  // second order in time, and in both.
  const double speed = 0.5 * plan.medium.sound_speed, width = plan.spectral_width2,
               turn = speed * wave * curvature.by_r;
  const double late = width * ((off + plan.doppler.centre) / pi - turn / (4 * pi * pi)),
               later = late - width * turn / (4 * pi * pi);
  const Complex second =
      0.5 * speed * speed * wave * curvature.by_r2 * Complex(0, width / (2 * pi * pi) + later * later) +
      speed * step * wave * curvature.by_ur * later * slope * std::conj(sum) / std::norm(sum);
  const Complex power = -turn * late - second;
  return std::polar(std::exp(power.real()), phase + power.imag()) * sum;
}

/// Nodes in range: what interpolation between n of them leaves of a phase that goes by `over_range` to either side,
/// and of its curvature over the range.
std::size_t range_nodes(const CurvaturePhase& phase, double near, double far, double tolerance) {
  const double ratio = (far - near) / (far + near);
  const auto most = static_cast<std::size_t>(std::ceil(-std::log10(tolerance)) + 1 + std::ceil(1.4 * phase.over_range));
  double turned = 1, curved = 1;
  for (std::size_t n = 1; n < most; ++n) {
    turned *= 0.5 * phase.over_range / static_cast<double>(n);
    curved *= 0.5 * ratio;
    if (n > 1 && 2 * turned + 2 * (phase.all + 0.3) * curved < node_share * tolerance) return n;
  }
  return most;
}

}  // namespace

std::vector<Complex> inverse_series(const TrueDelayPlan& plan, double frequency) {
  const auto all = plan.kernel_moments(frequency);
  std::vector<Complex> inverse(TrueDelayPlan::moments, 0);
  inverse[0] = 1;
  for (std::size_t j = 1; j < inverse.size(); ++j) {
    double factorial = 1;
    for (std::size_t k = 1; k <= j; ++k) {
      factorial *= static_cast<double>(k);
      inverse[j] -= all[k] / (factorial * all[0]) * inverse[j - k];
    }
  }
  return inverse;
}

RowPositions::RowPositions(const TrueDelayPlan& plan, double off) {
  // Smooth in frequency, and finite where the array is no longer than a row.
  const double carrier = plan.head.pulse.centre_frequency, rows = plan.medium.sound_speed / plan.period;
  row = rows / std::max(carrier - off, 0.15 * carrier);
  reach = 0.5 * plan.aperture + 0.6 * static_cast<double>(plan.taps) * rows / std::hypot(carrier - off, 0.3 * carrier);
}

double CurvatureSamples::shading_at(const TrueDelayPlan& plan, double y) {
  const double at = (y - plan.y.front()) / plan.head.array.spacing;
  const auto m = static_cast<std::ptrdiff_t>(std::lround(at));
  if (m < 0 || m >= static_cast<std::ptrdiff_t>(plan.elements())) return 0;
  return plan.head.array.shading[static_cast<std::size_t>(m)];
}

CurvatureSamples::CurvatureSamples(const TrueDelayPlan& plan, const CurvatureSpan& span) {
  place_nodes(plan, span);
  sample(plan, span);
  undo_rows(plan);
  mirror();
}

void CurvatureSamples::place_nodes(const TrueDelayPlan& plan, const CurvatureSpan& span) {
  const double c = plan.medium.sound_speed, least = 0.45 * plan.aperture;
  middle = 0.5 * (span.first_time + span.last_time);
  half = 0.5 * (span.last_time - span.first_time);
  // Take as many nodes as follow phases that change by this much.
  const double near = std::max(0.5 * c * span.first_time, std::max(least, 1e-3)),
               far = std::max(0.5 * c * span.last_time, near);
  const CurvaturePhase phase(plan.head, plan.medium, near, far);
  const auto nodes = [](double turn) { return static_cast<std::size_t>(std::ceil(1.4 * turn)); };
  const std::size_t count_u = static_cast<std::size_t>(std::max(8.0, 3.7 + 2 * plan.digits)) +
                              2 * nodes(0.5 * phase.all * span.widest * span.widest),
                    count_r = range_nodes(phase, near, far, plan.tolerance);
  for (std::size_t j = 0; j < count_u; ++j) u.push_back(span.widest * chebyshev_node(j, count_u));
  for (std::size_t j = 0; j < count_r; ++j)
    r.push_back(std::max(0.5 * c * (middle + half * chebyshev_node(j, count_r)), least));
  positions = count_u / 2 + static_cast<std::size_t>(std::max(9.0, 5.7 + 2 * plan.digits));
}

void CurvatureSamples::sample(const TrueDelayPlan& plan, const CurvatureSpan& span) {
  const double c = plan.medium.sound_speed;
  std::vector<std::vector<Complex>> moment;  // by column
  std::vector<double> y, mean;
  for (std::size_t f = 0; f < plan.node_frequency.size(); ++f)
    for (std::size_t i = 0; i < positions; ++i) {
      const double node = chebyshev_node(i, positions);
      y.push_back(RowPositions(plan, plan.node_frequency[f]).reach * node);
      mean.push_back(mean_curvature(span, y.back()));
      const double harmonic = plan.period * y.back() * (plan.head.pulse.centre_frequency - plan.node_frequency[f]) / c;
      moment.push_back(inverse_series(plan, harmonic / static_cast<double>(plan.grid)));
      weight.push_back(shading_at(plan, y.back()) * plan.node_weight[f] * std::pow(1 - node * node, 0.25));
    }
  value.resize(static_cast<Eigen::Index>(u.size() * r.size()), static_cast<Eigen::Index>(y.size()));
  for (std::size_t j = 0; j < half_of_u(); ++j)
    for (std::size_t k = 0; k < r.size(); ++k)
      for (std::size_t at = 0; at < y.size(); ++at) {
        const Curvature curvature(r[k], u[j], y[at]);
        const double off = plan.node_frequency[at / positions];
        const double turn = 2 * pi * (plan.head.pulse.centre_frequency - off) / c * (curvature.b - mean[at]);
        value(static_cast<Eigen::Index>(j * r.size() + k), static_cast<Eigen::Index>(at)) =
            undone(plan, curvature, turn, off, moment[at], span.echoes);
      }
}

void CurvatureSamples::undo_rows(const TrueDelayPlan& plan) {
  // Interpolation between rows k - d by a kernel sees slopes along k: a power series of them, undone by its reciprocal.
  const auto count_y = static_cast<Eigen::Index>(positions), count_r = static_cast<Eigen::Index>(r.size());
  const Eigen::MatrixXd slope = slope_at_nodes(positions);
  std::vector<Eigen::MatrixXd> power = {Eigen::MatrixXd::Identity(count_y, count_y)};
  while (power.size() < TrueDelayPlan::moments) power.push_back(slope * power.back());
  Eigen::MatrixXcd all(count_y, count_y);
  for (std::size_t j = 0; j < half_of_u(); ++j) {
    const std::vector<Complex> inverse = inverse_series(plan, u[j] / plan.period);
    for (std::size_t f = 0; f < plan.node_frequency.size(); ++f) {
      const RowPositions rows(plan, plan.node_frequency[f]);
      const double per_row = rows.row / rows.reach;
      auto values =
          value.block(static_cast<Eigen::Index>(j) * count_r, static_cast<Eigen::Index>(f) * count_y, count_r, count_y);
      const Eigen::MatrixXcd before = values.transpose();
      // Powers are added until those that follow are smaller than their share, by the steepest slope.
      const double steepest = std::abs(per_row) * ((slope * before.real()).cwiseAbs().maxCoeff() +
                                                   (slope * before.imag()).cwiseAbs().maxCoeff());
      double size = 1;
      all.setIdentity();
      double scale = 1;
      for (std::size_t n = 1; n < power.size(); ++n) {
        scale *= per_row, size *= steepest;
        all += scale * inverse[n] * power[n];
        if (n > 2 && n + 1 < power.size() &&
            size * (std::abs(inverse[n]) + steepest * std::abs(inverse[n + 1])) < row_share * plan.tolerance)
          break;
      }
      values = (all * before).transpose();
    }
  }
}

void CurvatureSamples::mirror() {
  const auto count_y = static_cast<Eigen::Index>(positions), count_r = static_cast<Eigen::Index>(r.size());
  for (std::size_t j = half_of_u(); j < u.size(); ++j)
    for (Eigen::Index first = 0; first < value.cols(); first += count_y)
      value.block(static_cast<Eigen::Index>(j) * count_r, first, count_r, count_y) =
          value.block(static_cast<Eigen::Index>(u.size() - 1 - j) * count_r, first, count_r, count_y)
              .rowwise()
              .reverse();
}

}  // namespace insonify
