// SPDX-License-Identifier: BSD-3-Clause
// A sweep whose period p(t) = p_0 + q t changes evenly from that of its lowest to that of its highest frequency. Motion
// stretches time by eta = 1 + f_d / f_c, and a stretched sweep is the sweep itself, later by (p_0 / q) (1 - 1 / eta):
// its matched filter loses no more than what no longer overlaps (Sonar velocity resolution with
// a linear-period-modulated pulse, J. Acoust. Soc. Am. 61, 1977, p. 1019).
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <memory>
#include <vector>

#include <unsupported/Eigen/FFT>

#include "core/units.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
namespace {

constexpr double samples_per_period = 8;  // of the bandwidth

/// The period of a sweep: p(t) = middle + slope t.
struct SweepPeriod {
  double middle, slope;
  explicit SweepPeriod(const Pulse& pulse) {
    const double first = 1 / (pulse.centre_frequency - 0.5 * pulse.bandwidth),
                 last = 1 / (pulse.centre_frequency + 0.5 * pulse.bandwidth);
    middle = 0.5 * (first + last), slope = (last - first) / pulse.duration;
  }
  /// Returns the phase at t [s] from the middle of the sweep, turned back by the carrier [rad].
  double phase(const Pulse& pulse, double t) const {
    return 2 * pi * (pulse.centre_frequency * t - std::log1p(slope * t / middle) / slope);  // (E202)
  }
};

double stretch_of(const Pulse& pulse, double doppler) { return 1 + doppler / pulse.centre_frequency; }

/// Tables that the echoes of a ping share: correlations of the sweep with its replica, each frequency weighted by a Chebyshev
/// polynomial over the band. What absorption leaves of the frequencies is a sum of these.
class SweepTables final : public PulseTables, public std::enable_shared_from_this<SweepTables> {
 public:
  static constexpr std::size_t most_terms = 12;
  /// Factors of the terms, and how many of them count.
  struct Terms {
    std::array<double, most_terms> factor = {};
    std::size_t used = 1;
  };

  SweepTables(const MatchedPulse& kind, const Pulse& pulse, const Absorption& absorption)
      : pulse_(pulse),
        absorption_(absorption),
        terms_(absorption.a1 == 0 && absorption.a2 == 0 ? 1 : most_terms),
        step_(pulse.duration / (2 * std::ceil(0.5 * samples_per_period * pulse.bandwidth * pulse.duration) + 1)),
        // A power of two, above twice the sweep and what a sweep stretched by a tenth has more.
        count_(std::bit_ceil(static_cast<std::size_t>(std::ceil(2.1 * pulse.duration / step_)) + 16)),
        value_(count_ * terms_) {
    const Samples sent = transformed(kind.samples(pulse, count_, step_, false, 0)),
                  replica = transformed(kind.samples(pulse, count_, step_, true, 0));
    const double cycle = static_cast<double>(count_) * step_, area = kind.weights(pulse).level * pulse.duration;
    Samples x(count_);
    for (std::size_t j = 0; j < terms_; ++j) {
      for (std::size_t k = 0; k < count_; ++k) {
        const double position = static_cast<double>(k) - (k < count_ / 2 ? 0 : static_cast<double>(count_));
        const double y = std::clamp(2 * position / (cycle * pulse.bandwidth), -1.0, 1.0);
        x[k] = sent[k] * std::conj(replica[k]) * (std::cos(static_cast<double>(j) * std::acos(y)) / (area * cycle));
      }
      const Samples term = transformed(x);
      for (std::size_t k = 0; k < count_; ++k) value_[k * terms_ + j] = term[k];
    }
  }

  /// Returns what absorption over `range` [m] leaves of a frequency that was sent `f` [Hz] off the carrier; beyond the
  /// ends of the sweep, as there.
  double kept(double range, double f) const {
    const double edge = 0.5 * pulse_.bandwidth, g = std::clamp(f, -edge, edge);
    return std::exp(-2 * (absorption_.a0 + g * (absorption_.a1 + g * absorption_.a2)) * range);
  }

  /// Returns the factors of the terms for an echo from `range` whose frequencies moved by `doppler` [Hz].
  Terms factors(double range, double doppler) const {
    constexpr double faint = 1e-7;  // of the first term
    Terms terms{{kept(range, 0)}};
    if (terms_ == 1) return terms;
    const auto n = static_cast<double>(terms_);
    for (std::size_t j = 0; j < terms_; ++j) {
      double& factor = terms.factor[j] = 0;
      for (std::size_t m = 0; m < terms_; ++m) {
        const double angle = pi * (static_cast<double>(m) + 0.5) / n;
        const double left = kept(range, 0.5 * pulse_.bandwidth * std::cos(angle) - doppler);
        factor += (j == 0 ? 1 : 2) / n * left * std::cos(static_cast<double>(j) * angle);
      }
      if (std::abs(factor) > faint * terms.factor[0]) terms.used = j + 1;
    }
    return terms;
  }

  /// Returns the sum of the terms at t [s] from the delay, between six samples (Lagrange).
  std::complex<double> at(double t, const Terms& terms) const {
    constexpr double divisor[] = {-120, 24, -12, 12, -24, 120};
    const double position = t / step_, whole = std::floor(position), x = position - whole;
    const double from[] = {x + 2, x + 1, x, x - 1, x - 2, x - 3};
    std::complex<double> sum = 0;
    for (std::ptrdiff_t k = 0; k < 6; ++k) {
      double weight = 1 / divisor[k];
      for (std::ptrdiff_t j = 0; j < 6; ++j)
        if (j != k) weight *= from[j];
      const auto sample = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(whole) + k - 2) & (count_ - 1);
      for (std::size_t j = 0; j < terms.used; ++j) sum += weight * terms.factor[j] * value_[sample * terms_ + j];
    }
    return sum;
  }

 private:
  using Samples = std::vector<std::complex<double>>;
  /// Returns the discrete Fourier transform, by Eigen's: this module needs no other package.
  static Samples transformed(const Samples& x) {
    Samples result;
    Eigen::FFT<double>().fwd(result, x);
    return result;
  }

  Pulse pulse_;
  Absorption absorption_;
  std::size_t terms_;
  double step_;  ///< an odd part of the sweep, so that no sample stands at its ends
  std::size_t count_;
  Samples value_;  ///< terms of each sample, cyclic from the delay on
};

/// One echo of a sweep. Stretched by motion it is the sweep itself, later and turned, but for what is more or less at
/// its two ends (E203).
class HyperbolicEcho final : public EchoShape {
 public:
  HyperbolicEcho(const Pulse& pulse, const SweepTables& tables, double range, double doppler)
      : pulse_(pulse), tables_(tables.shared_from_this()), period_(pulse), range_(range), doppler_(doppler) {
    terms_ = tables.factors(range, doppler);
    const double stretch = stretch_of(pulse, doppler);
    half_ = 0.5 * pulse.duration / stretch;
    late_ = period_.middle / period_.slope * (1 - 1 / stretch);
    turn_ = std::polar(1.0, 2 * pi * (pulse.centre_frequency * late_ - std::log(stretch) / period_.slope));
  }

  std::complex<double> at(double t) const override {
    if (!(std::abs(t) < pulse_.duration)) return 0;
    if (doppler_ == 0) return tables_->at(t, terms_);
    const double moved = t - late_, half = 0.5 * pulse_.duration;
    // Limits of the overlap of replica and sweep, and of the sweep at rest, in the time of the latter.
    const double first = std::max(-half_ - late_, moved - half), last = std::min(half_ - late_, moved + half);
    if (!(first < last)) return 0;
    return turn_ * (tables_->at(moved, terms_) - part(moved, std::max(-half, moved - half), first) +
                    part(moved, std::min(half, moved + half), last));
  }

 private:
  /// Returns the correlation at `t` over a short part of the sweep, in pieces along which the phase changes evenly.
  std::complex<double> part(double t, double from, double to) const {
    constexpr int pieces = 4;
    if (from == to) return 0;
    const auto phase = [&](double x) { return period_.phase(pulse_, x) - period_.phase(pulse_, x - t); };
    const double width = (to - from) / pieces, area = replica_weight(pulse_, 0.25 * pulse_.duration) * pulse_.duration;
    double before = phase(from);
    std::complex<double> sum = 0;
    for (int k = 0; k < pieces; ++k) {
      const double middle = from + (k + 0.5) * width, after = phase(from + (k + 1) * width);
      const double v = 0.5 * (after - before), f = 1 / (period_.middle + period_.slope * middle);
      const double kept = tables_->kept(range_, f - pulse_.centre_frequency - doppler_);
      sum += std::polar(kept * replica_weight(pulse_, middle - t) * (v == 0 ? 1 : std::sin(v) / v), phase(middle));
      before = after;
    }
    return width / area * sum;
  }

  Pulse pulse_;
  std::shared_ptr<const SweepTables> tables_;
  SweepPeriod period_;
  SweepTables::Terms terms_;
  double range_, doppler_, half_, late_;
  std::complex<double> turn_;
};

class HyperbolicFmPulse final : public MatchedPulse {
 public:
  HyperbolicFmPulse()
      : MatchedPulse({.name = "hyperbolic_fm",
                      .picture = "hyperbolic FM sweep",
                      .most_product = 2e4,
                      .products = "1 and 2e4",
                      .window = true}) {}

  std::shared_ptr<const PulseTables> tables(const Pulse& pulse, const Medium& medium) const override {
    if (medium.absorption.a1 != 0 || medium.absorption.a2 != 0) least_absorption(medium.absorption, edge(pulse), pulse);
    return std::make_shared<const SweepTables>(*this, pulse, medium.absorption);
  }
  EchoEnvelope echo(const Pulse& pulse, const Absorption&, double range, double doppler,
                    const PulseTables* tables) const override {
    EchoEnvelope envelope;
    envelope.shape = std::make_shared<HyperbolicEcho>(pulse, static_cast<const SweepTables&>(*tables), range, doppler);
    return envelope;
  }
  double phase(const Pulse& pulse, double t, double doppler) const override {
    const double stretch = stretch_of(pulse, doppler);
    return SweepPeriod(pulse).phase(pulse, stretch * t) + 2 * pi * pulse.centre_frequency * (1 - stretch) * t;
  }
  double arriving_length(const Pulse& pulse, double doppler) const override {
    return pulse.duration / stretch_of(pulse, doppler);
  }
  double doppler_delay(const Pulse& pulse, double doppler) const override {
    const SweepPeriod p(pulse);
    return p.middle / p.slope * (1 - 1 / stretch_of(pulse, doppler));  // (E203)
  }
  /// Where the sweep is slowest, at its lowest frequency, it is a linear one of less bandwidth.
  double half_length(const Pulse& pulse, double tolerance) const override {
    Pulse slow = pulse;
    slow.bandwidth *= (pulse.centre_frequency - edge(pulse)) / (pulse.centre_frequency + edge(pulse));
    return MatchedPulse::half_length(slow, tolerance);
  }
  /// Approximates by stationary phase: signal and replica spend p(t)^2 at each frequency.
  SpectrumMoments moments(const Pulse& pulse) const override {
    constexpr int parts = 64;
    const SweepPeriod p(pulse);
    double energy = 0, mean = 0, square = 0;
    for (int k = 0; k < parts; ++k) {
      const double t = pulse.duration * ((k + 0.5) / parts - 0.5), period = p.middle + p.slope * t;
      const double part = std::pow(replica_weight(pulse, t) * period, 2), f = 1 / period - pulse.centre_frequency;
      energy += part, mean += part * f, square += part * f * f;
    }
    mean /= energy;
    return {mean, std::sqrt(square / energy - mean * mean)};
  }
};

}  // namespace

const PulseKind& hyperbolic_fm_pulse() {
  static const HyperbolicFmPulse kind;
  return kind;
}

}  // namespace insonify
