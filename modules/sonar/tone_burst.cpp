// SPDX-License-Identifier: BSD-3-Clause
// A tone with sharp ends behind the filter that matches it: its spectrum is sinc(f T), its echo the triangle 1 - |t| / T.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/units.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
namespace {

/// The correlation of a shifted tone with its replica (E201).
class ToneBurstEcho final : public EchoShape {
 public:
  ToneBurstEcho(double length, double gain, double doppler) : length_(length), gain_(gain), doppler_(doppler) {}
  std::complex<double> at(double t) const override {
    const double overlap = length_ - std::abs(t), half_turn = pi * doppler_ * overlap;
    if (!(overlap > 0)) return 0;
    const double level = gain_ * overlap / length_;
    if (doppler_ == 0) return level;
    return std::polar(level * (half_turn == 0 ? 1 : std::sin(half_turn) / half_turn), -pi * doppler_ * t);  // (E201)
  }

 private:
  double length_, gain_, doppler_;
};

class ToneBurstPulse final : public MatchedPulse {
 public:
  ToneBurstPulse()
      : MatchedPulse(
            {.name = "tone_burst", .picture = "tone burst", .most_product = 0, .products = "", .window = false}) {}

  /// The echo keeps its triangle, with the energy that absorption leaves of the spectrum.
  EchoEnvelope echo(const Pulse& pulse, const Absorption& a, double range, double doppler,
                    const PulseTables*) const override {
    double energy = std::exp(-4 * a.a0 * range);
    if (a.a1 != 0 || a.a2 != 0) {
      least_absorption(a, edge(pulse), pulse);
      double kept = 0;
      for (const SpectrumNode& node : spectrum_nodes(pulse)) {
        const double f = std::clamp(node.frequency, -edge(pulse), edge(pulse));
        kept += node.weight * std::exp(-4 * (a.a0 + f * (a.a1 + f * a.a2)) * range);
      }
      energy = kept;
    }
    EchoEnvelope envelope;
    envelope.shape = std::make_shared<ToneBurstEcho>(length(pulse), std::sqrt(energy), doppler);
    return envelope;
  }
  double length(const Pulse& pulse) const override { return 1 / pulse.bandwidth; }
  double phase(const Pulse&, double t, double doppler) const override { return -2 * pi * doppler * t; }
  ReplicaWeights weights(const Pulse&) const override { return {1, 0}; }
  double edge(const Pulse& pulse) const override { return pulse.bandwidth; }

  double range_resolution(const Pulse& pulse, double sound_speed) const override {
    return 0.5 * sound_speed * (2 - std::numbers::sqrt2) * length(pulse);  // (E201)
  }
  double energy_length(const Pulse& pulse, double sound_speed) const override {
    return 0.5 * sound_speed * length(pulse) * 2 / 3;  // (E201)
  }
  double half_length(const Pulse& pulse, double tolerance) const override { return (1 - tolerance) * length(pulse); }
  /// Beyond x / T on both sides sinc^4 has 3 / (8 pi^4 x^3) of its integral: the square of the tolerance.
  double relative_band(const Pulse&, double tolerance) const override {
    constexpr double least = 4.5, most = 32;
    return std::clamp(std::cbrt(3 / (8 * std::pow(pi, 4) * tolerance * tolerance)), least, most);
  }
  SpectrumMoments moments(const Pulse& pulse) const override {
    return {0, std::sqrt(3.0) / (2 * pi) * pulse.bandwidth};  // of the integral of |dG/dt|^2 (E201)
  }
};

}  // namespace

const PulseKind& tone_burst_pulse() {
  static const ToneBurstPulse kind;
  return kind;
}

}  // namespace insonify
