// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <memory>

#include "sonar/water.hpp"

namespace insonify {

/// Kind of the transmitted pulse.
enum class PulseShape {
  gaussian,      ///< a short burst, as the receiver's filter passes it
  linear_fm,     ///< a sweep of the bandwidth, compressed by a matched filter
  tone_burst,    ///< a tone of length 1 / bandwidth with sharp ends, behind its matched filter
  hyperbolic_fm  ///< a sweep whose period changes evenly, compressed by a matched filter: it tolerates motion
};

class PulseKind;
const PulseKind& gaussian_pulse();       ///< E8
const PulseKind& linear_fm_pulse();      ///< E54
const PulseKind& tone_burst_pulse();     ///< E201
const PulseKind& hyperbolic_fm_pulse();  ///< E202

/// The kinds of pulses, in the order of PulseShape. This list is the table to which a new kind adds a row.
inline constexpr const PulseKind& (*pulse_kinds[])() = {gaussian_pulse, linear_fm_pulse, tone_burst_pulse,
                                                        hyperbolic_fm_pulse};

/// Weights of the replica that the matched filter uses: 1, or level + (1 - level) cos(2 pi t / duration) with level
/// 0.5 (hann) or 0.54 (hamming).
enum class ReplicaWindow { uniform, hann, hamming };

/// Returns the name in sonar files, e.g. "gaussian".
const char* pulse_shape_name(PulseShape shape);
/// Returns the name in sonar files: "uniform", "hann" or "hamming".
const char* replica_window_name(ReplicaWindow window);

/// The transmitted pulse as it leaves the receiver's filter: unit envelope peak, so that the level of an echo's peak is
/// the sonar equation.
struct Pulse {
  double centre_frequency = 0;  ///< [Hz]
  double bandwidth = 0;         ///< full -3 dB power width, swept band, or 1 / length of a tone [Hz]; see c/2B
  double source_level_db = 0;   ///< dB re 1 uPa rms at 1 m, on axis
  PulseShape shape = PulseShape::gaussian;
  double duration = 0;                            ///< duration of a sweep [s]; others' follow from the bandwidth
  ReplicaWindow window = ReplicaWindow::hamming;  ///< window of a sweep's replica

  bool operator==(const Pulse&) const = default;
};

/// Throws Error unless all is finite, 0 < bandwidth < 2 centre_frequency, -400 <= source_level_db <= 260 and, for a
/// sweep, 1 <= bandwidth duration <= 1e6 (linear) or 2e4 (hyperbolic).
void require_valid(const Pulse& pulse, const char* who);

/// Returns the peak pressure at 1 m on axis [Pa]: sqrt(2) 10^(SL/20) 1 uPa (E5).
double source_pressure(const Pulse& pulse);

/// Returns the full width at half maximum of the intensity as range [m]. Gaussian: 0.4413 c / 2B (E8). Tone burst:
/// (2 - sqrt 2) c / 2B (E201). Sweep: found numerically (E55); for bandwidth duration of 100 and more within 1 % of
/// 0.886 (uniform), 1.44 (hann) or 1.30 (hamming) c / 2B of a linear sweep.
double range_resolution(const Pulse& pulse, double sound_speed);

/// Returns the range over which an echo of the peak intensity would have the energy of the pulse [m]: c / 2 integral
/// |G|^2 dt. Gaussian: 0.4697 c / 2B (E8). Tone burst: 2/3 c / 2B (E201). Sweep: by a sum, within 1e-3.
double energy_length(const Pulse& pulse, double sound_speed);

/// Returns the range resolution of datasheets [m]: c / 2B.
double nominal_range_resolution(const Pulse& pulse, double sound_speed);

/// Fraction of the envelope's peak at which a pulse ends for paths and cells.
inline constexpr double pulse_floor = 1e-4;

/// Returns the half-length [s] beyond which the envelope is below `tolerance` of its peak, without absorption (E8);
/// tolerance in (0, 1). For a sweep it is an upper bound, at most its duration; the envelope is 0 beyond that (E54).
double pulse_half_length(const Pulse& pulse, double tolerance);

/// Returns the equivalent noise bandwidth of the receive filter [Hz], integral |H(f)|^2 df / |H(0)|^2. Gaussian pulse:
/// sqrt(pi / (4 ln 2)) B = 1.0645 B (E18). Matched filter of a sweep: integral w^2 / (integral w)^2 (E55), which is 1
/// (uniform), 1.5 (hann) or 1.363 (hamming) / duration.
double noise_bandwidth(const Pulse& pulse);

/// Returns the time by which a Doppler shift `doppler` [Hz] of the carrier displaces the peak of an echo [s]: -f_d T / B
/// of a linear sweep (E54), that of E203 of a hyperbolic one; 0 of a pulse of one frequency.
double doppler_delay(const Pulse& pulse, double doppler);

/// Returns the weight of the replica of a matched filter at t [s] from its middle; 1 of a pulse without one.
double replica_weight(const Pulse& pulse, double t);

/// Envelope of one echo of a kind that has a class of its own for it.
class EchoShape {
 public:
  virtual ~EchoShape() = default;
  /// Returns the envelope at t [s] from the echo's delay.
  virtual std::complex<double> at(double t) const = 0;
};

/// Envelope of one echo after a way of `range` out and back, with absorption frequency by frequency.
///
/// Gaussian in, Gaussian out (E8):
///
///   G(t) = sqrt((2 ln2 / B^2) / a) exp(-2 a0 r) exp((b + 2 pi i t)^2 / 4a),  a = 2 ln2 / B^2 + 2 a2 r,  b = 2 a1 r
///        = gain exp(-(pi t)^2 / a) exp(i pi b t / a),  gain = sqrt((2 ln2 / B^2) / a) exp(b^2 / 4a - 2 a0 r)
///
/// In the second form nothing overflows, however large the absorption.
/// With a1 = a2 = 0 it is exp(-2 a0 r) exp(-pi^2 B^2 t^2 / (2 ln2)), real. A Doppler shift f_d turns it as
/// exp(-2 pi i f_d t).
///
/// A linear sweep s(t) = exp(-i pi k t^2), k = B / T, |t| < T/2, rising in frequency, behind its matched filter with the
/// replica w s (E54):
///
///   G(t) = (1 / integral w) integral s_r(tau) exp(-2 pi i f_d tau) conj(w s)(tau - t) dtau
///
/// s_r is the sweep after its way: s exp(-2 a0 r) without slope and curvature of the absorption, else what the filter
/// exp(-2 (a0 + a1 f + a2 f^2) r) makes of an endless sweep of that rate, cut to |t| < T/2:
///
///   s_r(t) = sqrt(k'/k) exp(-2 a0 r + i k' b^2 / 4 pi - k' b t - i pi k' t^2),  k' = k / (1 + 2 i a2 r k / pi)
///
/// It differs from an exactly filtered sweep only at its ends. That raises or lowers far side lobes by at most 0.06 /
/// (B T)
/// of the peak per dB by which the loss differs over the band (held by a test up to 11 dB). Zero for |t| >= T. The peak
/// of a shifted echo stands at t = -f_d / k (range-Doppler coupling). Motion also stretches the sweep itself. This is
/// left out, an error of about B T f_d / f_c cycles at the ends. Accurate to 1e-12 of the peak.
struct EchoEnvelope {
  double gain = 0;                           ///< gain at the peak of a Gaussian, at most 1
  double a = 0;                              ///< [s^2]
  double b = 0;                              ///< [s]
  double doppler = 0;                        ///< Doppler shift of a Gaussian [Hz]
  std::shared_ptr<const EchoShape> shape{};  ///< echo of another kind, which replaces the members above

  std::complex<double> at(double t) const;  ///< envelope at t [s] from the echo's delay
};

/// Returns the envelope of one echo. Throws Error if slope or curvature of the absorption would make the pulse grow on
/// its way.
EchoEnvelope echo_envelope(const Pulse& pulse, const Absorption& absorption, double range);

/// Tables that the echoes of one ping share; each kind that needs some has its own.
struct PulseTables {
  virtual ~PulseTables() = default;
};

/// Envelopes of all echoes of one ping. Terms that the echoes share are computed once.
class EchoShapes {
 public:
  /// Throws Error for an invalid pulse.
  EchoShapes(const Pulse& pulse, const Medium& medium);

  /// Returns the envelope of the echo with this two-way delay [s] and Doppler shift [Hz]. Throws as echo_envelope does.
  EchoEnvelope of(double delay, double doppler = 0) const;

 private:
  Pulse pulse_;
  Medium medium_;
  const PulseKind* kind_;
  std::shared_ptr<const PulseTables> tables_;
};

}  // namespace insonify
