// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/pulse.hpp"

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/require.hpp"
#include "core/units.hpp"
#include "sonar/linear_fm_internal.hpp"

namespace insonify {
namespace {
constexpr double two_ln2 = 2 * std::numbers::ln2;
/// Intensity full width at half maximum times bandwidth of a Gaussian pulse: 2 ln2 / pi.
constexpr double intensity_width = two_ln2 / pi;
}  // namespace

const char* pulse_shape_name(PulseShape shape) { return shape == PulseShape::linear_fm ? "linear_fm" : "gaussian"; }

const char* replica_window_name(ReplicaWindow window) {
  if (window == ReplicaWindow::uniform) return "uniform";
  return window == ReplicaWindow::hann ? "hann" : "hamming";
}

void require_valid(const Pulse& pulse, const char* who) {
  require(std::isfinite(pulse.centre_frequency) && pulse.centre_frequency > 0, who, "centre_frequency",
          pulse.centre_frequency, "Hz", "> 0");
  if (!std::isfinite(pulse.bandwidth) || pulse.bandwidth <= 0 || pulse.bandwidth >= 2 * pulse.centre_frequency)
    fail(ErrorKind::argument, who, ": bandwidth = ", pulse.bandwidth, " Hz, must be > 0 and below twice the centre ",
         "frequency (", pulse.centre_frequency, " Hz)");
  require(pulse.source_level_db >= -400 && pulse.source_level_db <= 260, who, "source_level_db", pulse.source_level_db,
          "dB", "within -400 and 260");
  if (pulse.shape != PulseShape::linear_fm) return;
  if (!std::isfinite(pulse.duration) || pulse.duration <= 0)
    fail(ErrorKind::argument, who, ": duration = ", pulse.duration, " s, must be finite and > 0 for a sweep");
  if (const double product = pulse.bandwidth * pulse.duration; !(product >= 1 - 1e-9 && product <= 1e6))
    fail(ErrorKind::argument, who, ": duration = ", pulse.duration, " s times bandwidth = ", pulse.bandwidth, " Hz is ",
         product, ", must be within 1 and 1e6 for a sweep");
}

double source_pressure(const Pulse& pulse) {
  return std::numbers::sqrt2 * amplitude_from_db(pulse.source_level_db) * micropascal;  // (E5)
}

double range_resolution(const Pulse& pulse, double sound_speed) {
  if (pulse.shape == PulseShape::linear_fm) return sound_speed * linear_fm_half_width(pulse);  // (E55)
  return 0.5 * sound_speed * intensity_width / pulse.bandwidth;                                // (E8)
}

double nominal_range_resolution(const Pulse& pulse, double sound_speed) { return sound_speed / (2 * pulse.bandwidth); }

double noise_bandwidth(const Pulse& pulse) {
  if (pulse.shape != PulseShape::linear_fm) return std::sqrt(pi / (2 * two_ln2)) * pulse.bandwidth;  // (E18)
  const auto [level, swing] = replica_weights(pulse.window);
  return (1 + 0.5 * (swing * swing) / (level * level)) / pulse.duration;  // (E55)
}

double pulse_half_length(const Pulse& pulse, double tolerance) {
  if (!(tolerance > 0 && tolerance < 1))
    fail(ErrorKind::argument, "pulse_half_length: tolerance = ", tolerance, ", must be within 0 and 1");
  if (pulse.shape == PulseShape::linear_fm) return linear_fm_half_length(pulse, tolerance);
  return std::sqrt(-std::log(tolerance) * two_ln2) / (pi * pulse.bandwidth);  // (E8)
}

double replica_weight(const Pulse& pulse, double t) {
  const auto [level, swing] = replica_weights(pulse.window);
  return level + swing * std::cos(2 * pi * t / pulse.duration);
}

namespace {

EchoEnvelope gaussian_envelope(const Pulse& pulse, const Absorption& absorption, double range) {
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
  return {gain, a, b};
}

EchoEnvelope sweep_envelope(const Pulse& pulse, const Absorption& absorption, double range, double doppler,
                            const HermiteRules* rules) {
  EchoEnvelope envelope;
  envelope.sweep = std::make_shared<LinearFmEcho>(pulse, absorption, range, doppler, rules);
  return envelope;
}

}  // namespace

EchoEnvelope echo_envelope(const Pulse& pulse, const Absorption& absorption, double range) {
  if (pulse.shape != PulseShape::linear_fm) return gaussian_envelope(pulse, absorption, range);
  return EchoShapes(pulse, {2, absorption}).of(range);  // at 2 m/s the two-way delay is the range
}

EchoShapes::EchoShapes(const Pulse& pulse, const Medium& medium) : pulse_(pulse), medium_(medium) {
  require_valid(pulse, "EchoShapes");
  if (pulse.shape == PulseShape::linear_fm && medium.absorption.a2 != 0)
    rules_ = std::make_shared<const HermiteRules>();
}

EchoEnvelope EchoShapes::of(double delay, double doppler) const {
  const double range = 0.5 * medium_.sound_speed * delay;
  if (pulse_.shape == PulseShape::linear_fm)
    return sweep_envelope(pulse_, medium_.absorption, range, doppler, rules_.get());
  EchoEnvelope envelope = gaussian_envelope(pulse_, medium_.absorption, range);
  envelope.doppler = doppler;
  return envelope;
}

std::complex<double> EchoEnvelope::at(double t) const {
  if (sweep) return sweep->at(t);
  const double w = 2 * pi * t;
  const double magnitude = gain * std::exp(-w * w / (4 * a));  // (E8)
  if (doppler != 0) return std::polar(magnitude, b * w / (2 * a) - doppler * w);
  if (b == 0) return magnitude;
  return std::polar(magnitude, b * w / (2 * a));
}

}  // namespace insonify
