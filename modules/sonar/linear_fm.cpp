// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include <Eigen/Eigenvalues>

#include "core/error.hpp"
#include "core/units.hpp"
#include "sonar/pulse_kind.hpp"

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

/// Gauss-Hermite rules of several sizes, smallest first: sum_m weight f(node) = (1/sqrt(pi)) integral exp(-h^2) f dh.
struct HermiteRules final : PulseTables {
  struct Rule {
    std::vector<double> node, weight;
  };
  std::vector<Rule> rules;
  HermiteRules();
};

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

HermiteRules::HermiteRules() {
  for (const int n : {2, 4, 6, 8, 12, 16, 24, 32, 48, 64}) rules.push_back(hermite_rule(n));
}

/// One echo of a sweep behind its matched filter (E54). The absorption's slope over the band is an exponential along
/// the sweep. Its curvature is a Gaussian, an average of exponentials (Gauss-Hermite). Each exponential gives an
/// integral in closed form.
class LinearFmEcho final : public EchoShape {
 public:
  LinearFmEcho(const Pulse& pulse, ReplicaWeights window, const Absorption& absorption, double range, double doppler,
               const HermiteRules* rules);
  std::complex<double> at(double t) const override;

 private:
  /// The term weight exp(log_gain + slope tau) of the sweep's amplitude.
  struct Exponential {
    std::complex<double> log_gain, slope;
    double weight;
  };
  std::complex<double> lossless(double t) const;
  std::complex<double> lossy(double t) const;
  void add_losses(const Pulse& pulse, const Absorption& absorption, double range, const HermiteRules* rules);

  double duration_, rate_, doppler_;
  ReplicaWeights window_;
  double gain_;
  std::vector<Exponential> exponentials_;  ///< empty: the loss is the same at all frequencies
};

LinearFmEcho::LinearFmEcho(const Pulse& pulse, ReplicaWeights window, const Absorption& absorption, double range,
                           double doppler, const HermiteRules* rules)
    : duration_(pulse.duration),
      rate_(pulse.bandwidth / pulse.duration),
      doppler_(doppler),
      window_(window),
      gain_(std::exp(-2 * absorption.a0 * range)) {
  if (absorption.a1 != 0 || absorption.a2 != 0) add_losses(pulse, absorption, range, rules);
}

void LinearFmEcho::add_losses(const Pulse& pulse, const Absorption& absorption, double range,
                              const HermiteRules* rules) {
  const double least = least_absorption(absorption, 0.5 * pulse.bandwidth, pulse);
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

class LinearFmPulse final : public MatchedPulse {
 public:
  LinearFmPulse()
      : MatchedPulse({.name = "linear_fm",
                      .picture = "linear FM sweep",
                      .most_product = 1e6,
                      .products = "1 and 1e6",
                      .window = true}) {}

  std::shared_ptr<const PulseTables> tables(const Pulse&, const Medium& medium) const override {
    return medium.absorption.a2 == 0 ? nullptr : std::make_shared<const HermiteRules>();
  }
  EchoEnvelope echo(const Pulse& pulse, const Absorption& absorption, double range, double doppler,
                    const PulseTables* tables) const override {
    EchoEnvelope envelope;
    envelope.shape = std::make_shared<LinearFmEcho>(pulse, weights(pulse), absorption, range, doppler,
                                                    static_cast<const HermiteRules*>(tables));
    return envelope;
  }
  double phase(const Pulse& pulse, double t, double doppler) const override {
    const double rate = pulse.bandwidth / pulse.duration;
    return -pi * rate * t * t - 2 * pi * doppler * t;
  }
  double doppler_delay(const Pulse& pulse, double doppler) const override {
    return -doppler * pulse.duration / pulse.bandwidth;  // (E54)
  }
};

}  // namespace

const PulseKind& linear_fm_pulse() {
  static const LinearFmPulse kind;
  return kind;
}

}  // namespace insonify
