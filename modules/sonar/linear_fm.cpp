// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "core/error.hpp"
#include "core/units.hpp"
#include "sonar/linear_fm_internal.hpp"

namespace insonify {
namespace {

using Complex = std::complex<double>;
constexpr Complex i_unit{0, 1};

/// Loss at which echoes are silent [Np]: 80 Np are 695 dB.
constexpr double most_nepers = 80;

double sine_over(double u) { return std::abs(u) < 1e-9 ? 1 : std::sin(u) / u; }

/// Returns sinh(u) / u for small u.
Complex small_sinhc(Complex u) {
  const Complex v = u * u;
  return 1.0 + v / 6.0 * (1.0 + v / 20.0 * (1.0 + v / 42.0 * (1.0 + v / 72.0)));
}

/// Returns a Gauss-Hermite rule by the eigenvalues of its recurrence (Golub and Welsch 1969).
HermiteRules::Rule hermite_rule(int n) {
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd beside(n - 1);
  for (int m = 1; m < n; ++m) beside[m - 1] = std::sqrt(0.5 * m);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, beside);
  HermiteRules::Rule rule;
  for (int m = 0; m < n; ++m) {
    rule.node.push_back(solver.eigenvalues()[m]);
    rule.weight.push_back(solver.eigenvectors()(0, m) * solver.eigenvectors()(0, m));
  }
  return rule;
}

/// Returns the log of n! and, unlike std::lgamma, writes no global variable, so that several threads may call it.
double log_factorial(double n) {
  int sign = 0;
  return lgamma_r(n + 1, &sign);
}

/// Returns the log of the error of n nodes for exp(2 x h): the first derivative that the rule misses.
double log_hermite_error(std::size_t n, double x) {
  const auto m = static_cast<double>(n);
  return 2 * m * std::log(2 * x) + log_factorial(m) - log_factorial(2 * m) - m * std::log(2.0);
}

/// Returns the least loss of the frequencies in [-half_band, half_band] [Np/m].
double least_absorption(const Absorption& a, double half_band) {
  double least = std::min(a.a0 - a.a1 * half_band, a.a0 + a.a1 * half_band) + a.a2 * half_band * half_band;
  const double lowest = a.a2 > 0 ? -a.a1 / (2 * a.a2) : 2 * half_band;
  if (std::abs(lowest) < half_band) least = a.a0 - a.a1 * a.a1 / (4 * a.a2);
  return least;
}

}  // namespace

ReplicaWeights replica_weights(ReplicaWindow window) {
  if (window == ReplicaWindow::hann) return {0.5, 0.5};
  if (window == ReplicaWindow::hamming) return {0.54, 0.46};
  return {1, 0};
}

HermiteRules::HermiteRules() {
  for (const int n : {2, 4, 6, 8, 12, 16, 24, 32, 48, 64}) rules.push_back(hermite_rule(n));
}

LinearFmEcho::LinearFmEcho(const Pulse& pulse, const Absorption& absorption, double range, double doppler,
                           const HermiteRules* rules)
    : duration_(pulse.duration),
      rate_(pulse.bandwidth / pulse.duration),
      doppler_(doppler),
      window_(replica_weights(pulse.window)),
      gain_(std::exp(-2 * absorption.a0 * range)) {
  if (absorption.a1 != 0 || absorption.a2 != 0) add_losses(pulse, absorption, range, rules);
}

void LinearFmEcho::add_losses(const Pulse& pulse, const Absorption& absorption, double range,
                              const HermiteRules* rules) {
  const double least = least_absorption(absorption, 0.5 * pulse.bandwidth);
  if (!(least >= -1e-9 * absorption.a0))
    fail(ErrorKind::argument, "echo_envelope: absorption slope ", absorption.a1, " Np/m/Hz and curvature ",
         absorption.a2, " Np/m/Hz^2 turn a sweep over ", pulse.bandwidth,
         " Hz into a growing one; use absorption order 0, or a smaller bandwidth");
  if (2 * least * range > most_nepers) {
    gain_ = 0;
    return;
  }
  // Begin with an endless sweep after its way: exponents along the sweep, of orders 0, 1 and 2 (E54).
  const double b = 2 * absorption.a1 * range, c = 2 * absorption.a2 * range;
  const Complex ratio = 1.0 / (1.0 + i_unit * (c * rate_ / pi)), k = rate_ * ratio;
  const Complex log_gain = 0.5 * std::log(ratio) - 2 * absorption.a0 * range + i_unit * k * (b * b / (4 * pi));
  const Complex slope = -k * b - 2 * pi * i_unit * doppler_;
  if (c == 0) {
    exponentials_ = {{log_gain, slope, 1}};
    return;
  }
  // Write the curvature exp(-x^2 y^2), y = 2 tau / T, as an average of exp(2 i x y h) over Gaussian h.
  const Complex x = std::sqrt(c * rate_ * rate_ * ratio) * (0.5 * duration_);
  const auto rule = std::find_if(rules->rules.begin(), rules->rules.end(), [&](const HermiteRules::Rule& r) {
    return log_hermite_error(r.node.size(), std::abs(x)) < std::log(1e-13);
  });
  if (rule == rules->rules.end())
    fail(ErrorKind::argument, "echo_envelope: absorption curvature ", absorption.a2, " Np/m/Hz^2 at ", range,
         " m costs the ends of a sweep over ", pulse.bandwidth, " Hz ", std::norm(x),
         " Np more than its middle, must be below 30 Np; use absorption order 0 or 1, or a smaller bandwidth");
  for (std::size_t m = 0; m < rule->node.size(); ++m)
    exponentials_.push_back({log_gain, slope + 2.0 * i_unit * x * (2 * rule->node[m] / duration_), rule->weight[m]});
}

Complex LinearFmEcho::at(double t) const {
  if (!(std::abs(t) < duration_) || gain_ == 0) return 0;
  return exponentials_.empty() ? lossless(t) : lossy(t);
}

// Over the overlap of echo and replica, x = tau - t/2 within -L/2 and L/2, the integrand is w(x - t/2) times
// exp(-2 pi i (k t + f_d) x): three exponentials.
Complex LinearFmEcho::lossless(double t) const {
  const double overlap = duration_ - std::abs(t);
  const double q = pi * (rate_ * t + doppler_) * overlap;
  Complex sum = window_.level * sine_over(q);
  if (window_.swing != 0) {
    const double turn = pi * t / duration_, b = pi * overlap / duration_;
    const double below = sine_over(q - b), above = sine_over(q + b);
    sum += 0.5 * window_.swing * Complex((above + below) * std::cos(turn), (above - below) * std::sin(turn));
  }
  sum *= gain_ * overlap / (window_.level * duration_);  // (E54)
  return doppler_ == 0 ? sum : sum * std::polar(1.0, -pi * doppler_ * t);
}

// Integrates with complex frequencies. Exponentials are taken at the ends of the overlap, where they are values of the
// integrand, so that nothing overflows.
Complex LinearFmEcho::lossy(double t) const {
  const double overlap = duration_ - std::abs(t), first = 0.5 * (t - overlap), last = 0.5 * (t + overlap);
  const double harmonic = 2 * pi / duration_;
  const Complex chirp = -2 * pi * i_unit * rate_ * t;
  Complex sum = 0;
  for (const Exponential& e : exponentials_) {
    const Complex at_first = std::exp(e.log_gain + e.slope * first - 0.5 * chirp * overlap);
    const Complex at_last = std::exp(e.log_gain + e.slope * last + 0.5 * chirp * overlap);
    for (int v = window_.swing == 0 ? 0 : -1; v <= (window_.swing == 0 ? 0 : 1); ++v) {
      const Complex turn_first = std::polar(1.0, v * harmonic * (first - t)),
                    turn_last = std::polar(1.0, v * harmonic * (last - t));
      const Complex slope = e.slope + chirp + i_unit * (v * harmonic), u = 0.5 * overlap * slope;
      const Complex integral = std::abs(u) < 0.1 ? overlap * std::exp(e.log_gain + 0.5 * e.slope * t) *
                                                       std::polar(1.0, -0.5 * v * harmonic * t) * small_sinhc(u)
                                                 : (at_last * turn_last - at_first * turn_first) / slope;
      sum += e.weight * (v == 0 ? window_.level : 0.5 * window_.swing) * integral;  // (E54)
    }
  }
  return sum / (window_.level * duration_);
}

double linear_fm_half_width(const Pulse& pulse) {
  const LinearFmEcho echo(pulse, {}, 0, 0, nullptr);
  const auto above = [&](double t) { return std::norm(echo.at(t)) > 0.5; };
  // Find the first step below half the peak, then bisect.
  const double step = 0.02 / pulse.bandwidth;
  double inside = 0, outside = step;
  while (above(outside)) inside = outside, outside += step;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (inside + outside);
    (above(middle) ? inside : outside) = middle;
  }
  return outside;  // (E55)
}

double linear_fm_half_length(const Pulse& pulse, double tolerance) {
  const double duration = pulse.duration, main_lobe = 2 / pulse.bandwidth;
  const auto [level, swing] = replica_weights(pulse.window);
  // Behind the main lobe the envelope comes from the two ends of the overlap: that of the replica on one side and that
  // of the echo on the other, where the replica's weight is that at T/2 - t.
  const auto bound = [&](double t) {
    const double f = pulse.bandwidth * t / duration, h = 1 / duration;
    const Complex turn = std::polar(1.0, 2 * pi * t / duration);
    const double replica_end = std::abs(level / f - swing * f / (f * f - h * h));
    const double echo_end = std::abs(level / f - 0.5 * swing * (std::conj(turn) / (f - h) + turn / (f + h)));
    return (replica_end + echo_end) / (2 * pi * level * duration);
  };
  constexpr int steps = 4096;
  if (main_lobe >= duration) return duration;
  for (int n = steps; n > 0; --n) {
    const double t = main_lobe * std::pow(duration / main_lobe, static_cast<double>(n - 1) / steps);
    if (bound(t) > tolerance)
      return std::min(duration, main_lobe * std::pow(duration / main_lobe, static_cast<double>(n) / steps));
  }
  return main_lobe;
}

}  // namespace insonify
