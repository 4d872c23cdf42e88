#include "acoustics/pulse.hpp"

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {
constexpr double two_ln2 = 2 * std::numbers::ln2;
/// Intensity full width at half maximum times bandwidth of a Gaussian pulse: 2 ln2 / pi.
constexpr double intensity_width = two_ln2 / pi;
}  // namespace

void require_valid(const Pulse& pulse, const char* who) {
  if (!std::isfinite(pulse.centre_frequency) || pulse.centre_frequency <= 0)
    fail(ErrorKind::argument, who, ": centre_frequency = ", pulse.centre_frequency, " Hz, must be > 0");
  if (!std::isfinite(pulse.bandwidth) || pulse.bandwidth <= 0 || pulse.bandwidth >= 2 * pulse.centre_frequency)
    fail(ErrorKind::argument, who, ": bandwidth = ", pulse.bandwidth, " Hz, must be > 0 and below twice the centre ",
         "frequency (", pulse.centre_frequency, " Hz)");
  if (!(std::abs(pulse.source_level_db) <= 400))
    fail(ErrorKind::argument, who, ": source_level_db = ", pulse.source_level_db, " dB, must be within -400 and 400");
}

double source_pressure(const Pulse& pulse) {
  return std::numbers::sqrt2 * amplitude_from_db(pulse.source_level_db) * micropascal;  // (E5)
}

double range_resolution(const Pulse& pulse, double sound_speed) {
  return 0.5 * sound_speed * intensity_width / pulse.bandwidth;  // (E8)
}

double pulse_half_length(const Pulse& pulse, double tolerance) {
  if (!(tolerance > 0 && tolerance < 1))
    fail(ErrorKind::argument, "pulse_half_length: tolerance = ", tolerance, ", must be within 0 and 1");
  return std::sqrt(-std::log(tolerance) * two_ln2) / (pi * pulse.bandwidth);  // (E8)
}

EchoEnvelope echo_envelope(const Pulse& pulse, const Absorption& absorption, double range) {
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

std::complex<double> EchoEnvelope::at(double t) const {
  const double w = 2 * pi * t;
  const double magnitude = gain * std::exp(-w * w / (4 * a));  // (E8)
  if (b == 0) return magnitude;
  return std::polar(magnitude, b * w / (2 * a));
}

}  // namespace insonify
