// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/pulse.hpp"

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/require.hpp"
#include "core/units.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {

const char* pulse_shape_name(PulseShape shape) { return kind_of(shape).traits().name; }

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
  const double most = kind_of(pulse).traits().most_product;
  if (most == 0) return;
  if (!std::isfinite(pulse.duration) || pulse.duration <= 0)
    fail(ErrorKind::argument, who, ": duration = ", pulse.duration, " s, must be finite and > 0 for a sweep");
  if (const double product = pulse.bandwidth * pulse.duration; !(product >= 1 - 1e-9 && product <= most))
    fail(ErrorKind::argument, who, ": duration = ", pulse.duration, " s times bandwidth = ", pulse.bandwidth, " Hz is ",
         product, ", must be within ", kind_of(pulse).traits().products, " for a sweep");
}

double source_pressure(const Pulse& pulse) {
  return std::numbers::sqrt2 * amplitude_from_db(pulse.source_level_db) * micropascal;  // (E5)
}

double range_resolution(const Pulse& pulse, double sound_speed) {
  return kind_of(pulse).range_resolution(pulse, sound_speed);
}

double energy_length(const Pulse& pulse, double sound_speed) {
  return kind_of(pulse).energy_length(pulse, sound_speed);
}

double nominal_range_resolution(const Pulse& pulse, double sound_speed) { return sound_speed / (2 * pulse.bandwidth); }

double noise_bandwidth(const Pulse& pulse) { return kind_of(pulse).noise_bandwidth(pulse); }

double pulse_half_length(const Pulse& pulse, double tolerance) {
  if (!(tolerance > 0 && tolerance < 1))
    fail(ErrorKind::argument, "pulse_half_length: tolerance = ", tolerance, ", must be within 0 and 1");
  return kind_of(pulse).half_length(pulse, tolerance);
}

double doppler_delay(const Pulse& pulse, double doppler) { return kind_of(pulse).doppler_delay(pulse, doppler); }

double replica_weight(const Pulse& pulse, double t) {
  const MatchedPulse* const matched = kind_of(pulse).matched();
  if (!matched) return 1;
  const auto [level, swing] = matched->weights(pulse);
  return level + swing * std::cos(2 * pi * t / matched->length(pulse));
}

EchoEnvelope echo_envelope(const Pulse& pulse, const Absorption& absorption, double range) {
  const PulseKind& kind = kind_of(pulse);
  if (kind.traits().gaussian) return kind.echo(pulse, absorption, range, 0, nullptr);
  return EchoShapes(pulse, {2, absorption}).of(range);  // at 2 m/s the two-way delay is the range
}

EchoShapes::EchoShapes(const Pulse& pulse, const Medium& medium)
    : pulse_(pulse), medium_(medium), kind_(&kind_of(pulse)) {
  require_valid(pulse, "EchoShapes");
  tables_ = kind_->tables(pulse, medium);
}

EchoEnvelope EchoShapes::of(double delay, double doppler) const {
  const double range = 0.5 * medium_.sound_speed * delay;
  return kind_->echo(pulse_, medium_.absorption, range, doppler, tables_.get());
}

std::complex<double> EchoEnvelope::at(double t) const {
  if (shape) return shape->at(t);
  const double w = 2 * pi * t;
  const double magnitude = gain * std::exp(-w * w / (4 * a));  // (E8)
  if (doppler != 0) return std::polar(magnitude, b * w / (2 * a) - doppler * w);
  if (b == 0) return magnitude;
  return std::polar(magnitude, b * w / (2 * a));
}

}  // namespace insonify
