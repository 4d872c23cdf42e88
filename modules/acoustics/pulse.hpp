#pragma once
#include <complex>

#include "acoustics/water.hpp"

namespace insonify {

/// The transmitted pulse: Gaussian, unit envelope peak, so that the level of an echo's peak is the sonar equation.
struct Pulse {
  double centre_frequency = 0;  ///< [Hz]
  double bandwidth = 0;         ///< full -3 dB power width [Hz]; datasheet "range resolution" is c/2B
  double source_level_db = 0;   ///< dB re 1 uPa rms at 1 m, on axis
};

/// Throws Error unless all is finite, 0 < bandwidth < 2 centre_frequency and -400 <= source_level_db <= 400.
void require_valid(const Pulse& pulse, const char* who);

/// Peak pressure at 1 m on axis [Pa]: sqrt(2) 10^(SL/20) 1 uPa (E5).
double source_pressure(const Pulse& pulse);

/// Intensity full width at half maximum as range [m]: 0.4413 c / 2B (E8).
double range_resolution(const Pulse& pulse, double sound_speed);

/// Half-length [s] beyond which the envelope is below `tolerance` of its peak (E8); tolerance in (0, 1).
double pulse_half_length(const Pulse& pulse, double tolerance);

/// Envelope of one echo after a way of `range` there and back, with absorption frequency by frequency (E8).
/// Gaussian in, Gaussian out: computed once per echo, then sampled.
///
///   G(t) = sqrt((2 ln2 / B^2) / a) exp(-2 a0 r) exp((b + 2 pi i t)^2 / 4a),  a = 2 ln2 / B^2 + 2 a2 r,  b = 2 a1 r
///        = gain exp(-(pi t)^2 / a) exp(i pi b t / a),  gain = sqrt((2 ln2 / B^2) / a) exp(b^2 / 4a - 2 a0 r)
///
/// In the second form nothing overflows, however large the absorption.
/// With a1 = a2 = 0 it is exp(-2 a0 r) exp(-pi^2 B^2 t^2 / (2 ln2)), real.
struct EchoEnvelope {
  double gain = 0;  ///< at the peak, at most 1
  double a = 0;     ///< [s^2]
  double b = 0;     ///< [s]

  std::complex<double> at(double t) const;  ///< t [s] from the echo's delay
};

/// Throws Error if slope or curvature of the absorption would make the pulse grow on its way.
EchoEnvelope echo_envelope(const Pulse& pulse, const Absorption& absorption, double range);

}  // namespace insonify
