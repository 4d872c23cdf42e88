// SPDX-License-Identifier: BSD-3-Clause
// Small-slope approximation of a fluid sediment with relief of a power-law spectrum: Jackson and Richardson,
// High-Frequency Seafloor Acoustics (2007), chapter 13; Gragg, Wurmser and Gauss (2001). Volume by first-order
// perturbation, as chapter 14.
#include <cmath>
#include <numbers>
#include <utility>

#include "acoustics/surface_laws.hpp"
#include "acoustics/tabulated_surface_internal.hpp"
#include "core/require.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using complex = std::complex<double>;

constexpr double small_p = 0.02;  // below it five terms of a series are exact to 1e-6

/// sum over n >= 1 of (-p)^n / n! 2^(2 alpha n + 1) Gamma(1 + alpha n) / Gamma(-alpha n).
double integral_at_small(double alpha, double p) {
  double sum = 0, factor = 1;
  for (int n = 1; n <= 5; ++n) {
    factor *= -p / n;
    // Euler's reflection formula: 1 / Gamma(-x) = -sin(pi x) Gamma(1 + x) / pi.
    const double x = alpha * n, g = std::tgamma(1 + x);
    sum -= factor * std::pow(2, 2 * x + 1) * g * g * std::sin(pi * x) / pi;
  }
  return sum;
}

/// The mean of exp(-y) 2 y over y = 1 / (4 S), S = p^(1 / alpha) times a one-sided stable number of index alpha, which
/// is (a(turn) / w)^((1 - alpha) / alpha) for a uniform turn in (0, pi) and an exponential w.
double integral_as_mean(double alpha, double p) {
  constexpr int turns = 32;
  constexpr double step = 0.5, least = -20, most = 4;  // of ln w
  const double power = (1 - alpha) / alpha, scale = 0.25 * std::pow(p, -1 / alpha);
  double sum = 0;
  for (int j = 0; j < turns; ++j) {
    const double v = (j + 0.5) / turns, turn = pi * v * v * v * (10 - v * (15 - 6 * v)),
                 weight = 30 * v * v * (1 - v) * (1 - v) / turns;
    const double log_a = std::log(std::sin((1 - alpha) * turn)) +
                         (alpha * std::log(std::sin(alpha * turn)) - std::log(std::sin(turn))) / (1 - alpha);
    for (double log_w = least; log_w < most; log_w += step) {
      const double y = scale * std::exp(power * (log_w - log_a));
      if (y > 700) break;
      sum += weight * step * std::exp(log_w - std::exp(log_w) - y) * 2 * y;
    }
  }
  return sum;
}

/// I(p) between entries over ln p.
class IntegralTable {
 public:
  explicit IntegralTable(double alpha) : alpha_(alpha) {
    for (int k = -1; k <= entries + 1; ++k)
      log_.push_back(std::log(integral_as_mean(alpha, small_p * std::exp(k * step))));
  }
  double operator()(double p) const {
    if (p < small_p) return integral_at_small(alpha_, p);
    const double x = std::log(p / small_p) / step;
    if (x >= entries) return std::exp(log_[entries + 1]) * std::pow(p / large(), -1 / alpha_) * tail(p) / tail(large());
    const auto k = static_cast<std::size_t>(x);
    const double f = x - static_cast<double>(k), *l = &log_[k];  // a cubic through four entries
    return std::exp(f * (f - 1) * ((f + 1) * l[3] - (f - 2) * l[0]) / 6 +
                    (f + 1) * (f - 2) * ((f - 1) * l[1] - f * l[2]) / 2);
  }

 private:
  /// The first two terms of the series in p^(-1 / alpha), over the first.
  double tail(double p) const {
    return 1 - 0.25 * std::pow(p, -1 / alpha_) * std::tgamma(2 / alpha_) / std::tgamma(1 / alpha_);
  }
  static double large() { return small_p * std::exp(entries * step); }

  static constexpr int entries = 54;
  static constexpr double step = 0.15;
  double alpha_;
  std::vector<double> log_;  ///< logarithms of the integral, from one step before small_p to one beyond the last
};

class SmallSlopeSurface final : public SurfaceScattering {
 public:
  SmallSlopeSurface(const SmallSlopeLaw& law, double frequency, double sound_speed)
      : bed_(law, frequency, sound_speed, "surface_of"), integral_(bed_.alpha), back_([this](double cosine) {
          return cross_section({cosine, cosine, 1}) / cosine;
        }) {}

  double cross_section(const PathAngles& path) const override {
    if (!(path.cos_in > 0 && path.cos_out > 0)) return 0;
    return roughness(path) + volume(path);
  }
  double back(double cosine) const override { return back_(cosine); }
  double lobe_slope() const override {
    const double al = bed_.alpha, q3 = 2 * bed_.k;
    return std::min(1.0, std::pow(0.5 * bed_.c, 1 / (2 * al)) * std::pow(q3, 1 / al - 1));
  }

 private:
  double roughness(const PathAngles& path) const {
    const double ci = path.cos_in, co = path.cos_out, k = bed_.k, rho = bed_.rho;
    // The horizontal part of the cosine between both ends: what comes is opposite to where it comes from.
    const double across = co * ci - path.cos_between;  // cos(gi) cos(go) cos(phi)
    const complex a =
        0.5 * k * k * (1.0 + bed_.reflection(ci)) * (1.0 + bed_.reflection(co)) *
        ((1 - 1 / rho) * (bed_.root(ci) * bed_.root(co) / rho - across) + 1.0 - bed_.kappa * bed_.kappa / rho);
    const double q2 = k * k * std::max(2 - ci * ci - co * co - 2 * across, 0.0) + k * k * 1e-6, q3 = k * (ci + co);
    const double p = 0.5 * bed_.c * q3 * q3 * std::pow(q2, -bed_.alpha);
    return std::norm(a) * integral_(p) / (2 * pi * q2 * q3 * q3);  // (E141)
  }
  double volume(const PathAngles& path) const {
    const double in = std::norm(1.0 + bed_.reflection(path.cos_in)),
                 out = std::norm(1.0 + bed_.reflection(path.cos_out));
    return 10 * bed_.delta * bed_.sigma2 * in * out /
           (bed_.nu * std::numbers::ln10 * bed_.rho * bed_.rho *
            (bed_.root(path.cos_in) + bed_.root(path.cos_out)).imag());
  }

  FluidBed bed_;
  IntegralTable integral_;
  CosineTable back_;
};

}  // namespace

double small_slope_integral(double alpha, double p) {
  require(alpha > 0 && alpha < 1, "small_slope_integral", "alpha", alpha, "", "within 0 and 1 (excluded)");
  require(p > 0 && std::isfinite(p), "small_slope_integral", "p", p, "", "finite and > 0");
  return IntegralTable(alpha)(p);
}

std::shared_ptr<const SurfaceScattering> surface_of(const SmallSlopeLaw& law, double frequency, double sound_speed) {
  return std::make_shared<const SmallSlopeSurface>(law, frequency, sound_speed);
}

}  // namespace insonify
