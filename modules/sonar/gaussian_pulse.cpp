// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/units.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
namespace {

constexpr double two_ln2 = 2 * std::numbers::ln2;
/// Intensity full width at half maximum times bandwidth of a Gaussian pulse: 2 ln2 / pi.
constexpr double intensity_width = two_ln2 / pi;

class GaussianPulse final : public PulseKind {
 public:
  GaussianPulse()
      : PulseKind({.name = "gaussian",
                   .picture = "Gaussian",
                   .most_product = 0,
                   .products = "",
                   .window = false,
                   .gaussian = true}) {}

  EchoEnvelope echo(const Pulse& pulse, const Absorption& absorption, double range, double doppler,
                    const PulseTables*) const override {
    const double a_sent = two_ln2 / (pulse.bandwidth * pulse.bandwidth);
    const double a = a_sent + 2 * absorption.a2 * range;
    if (!(a > 0))
      fail(ErrorKind::argument, "echo_envelope: absorption curvature ", absorption.a2, " Np/m/Hz^2 at ", range,
           " m turns the pulse into a growing one; use absorption order 0 or 1");
    const double b = 2 * absorption.a1 * range;
    const double gain = std::sqrt(a_sent / a) * std::exp(b * b / (4 * a) - 2 * absorption.a0 * range);  // (E8)
    if (!(gain <= 1 + 1e-9))
      fail(ErrorKind::argument, "echo_envelope: absorption slope ", absorption.a1, " Np/m/Hz at ", range,
           " m turns the pulse into a growing one (gain ", gain, "); use absorption order 0, or a smaller bandwidth");
    return {gain, a, b, doppler};
  }
  double range_resolution(const Pulse& pulse, double sound_speed) const override {
    return 0.5 * sound_speed * intensity_width / pulse.bandwidth;  // (E8)
  }
  double energy_length(const Pulse& pulse, double sound_speed) const override {
    return std::sqrt(pi / (4 * std::log(2))) * range_resolution(pulse, sound_speed);  // (E8)
  }
  double half_length(const Pulse& pulse, double tolerance) const override {
    return std::sqrt(-std::log(tolerance) * two_ln2) / (pi * pulse.bandwidth);  // (E8)
  }
  double noise_bandwidth(const Pulse& pulse) const override {
    return std::sqrt(pi / (2 * two_ln2)) * pulse.bandwidth;  // (E18)
  }
  double relative_band(const Pulse&, double tolerance) const override {
    return std::sqrt(-std::log(tolerance) / (2 * std::numbers::ln2));
  }
  SpectrumMoments moments(const Pulse& pulse) const override { return {0, pulse.bandwidth * 0.424660900144}; }
};

}  // namespace

const PulseKind& gaussian_pulse() {
  static const GaussianPulse kind;
  return kind;
}

}  // namespace insonify
