// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <complex>
#include <limits>
#include <memory>
#include <vector>

#include "sonar/pulse.hpp"

namespace insonify {

/// A frequency off the carrier [Hz], and its fraction of a pulse's energy.
struct SpectrumNode {
  double frequency, weight;
};

/// Mean and standard deviation of a pulse's frequencies off the carrier by energy [Hz].
struct SpectrumMoments {
  double mean, deviation;
};

/// Properties that code outside of a kind of pulse asks for.
struct PulseTraits {
  const char* name;       ///< word in sonar files
  const char* picture;    ///< name in pictures
  double most_product;    ///< greatest bandwidth times duration; 0: the length follows from the bandwidth
  const char* products;   ///< limits of that product in words
  bool window;            ///< true: the replica may have a window
  bool gaussian = false;  ///< true: echoes are Gaussians (E8), which fast forms take by their members gain, a and b
};

class MatchedPulse;

/// A kind of pulse as code outside of it sees it: one file and one row of pulse_kinds each. Pulses given are valid.
class PulseKind {
 public:
  /// Constructs a kind with these properties.
  explicit PulseKind(const PulseTraits& traits) : traits_(traits) {}
  virtual ~PulseKind() = default;
  /// Returns the properties of the kind.
  const PulseTraits& traits() const { return traits_; }
  /// Returns the kind as one behind a matched filter; nullptr of another.
  virtual const MatchedPulse* matched() const { return nullptr; }

  /// Returns what echoes share in this medium; nullptr of a kind that needs nothing.
  virtual std::shared_ptr<const PulseTables> tables(const Pulse&, const Medium&) const { return nullptr; }
  /// Returns the envelope as EchoShapes::of does, from a one-way range [m]; `tables` are those of the pulse.
  virtual EchoEnvelope echo(const Pulse& pulse, const Absorption& absorption, double range, double doppler,
                            const PulseTables* tables) const = 0;
  /// Returns the width of the intensity at half its maximum as range [m].
  virtual double range_resolution(const Pulse& pulse, double sound_speed) const = 0;
  /// Returns the range over which the peak intensity would have the energy of the pulse [m].
  virtual double energy_length(const Pulse& pulse, double sound_speed) const = 0;
  /// Returns the half length [s] beyond which the envelope is below `tolerance` of its peak.
  virtual double half_length(const Pulse& pulse, double tolerance) const = 0;
  /// Returns the equivalent noise bandwidth of the receive filter [Hz].
  virtual double noise_bandwidth(const Pulse& pulse) const = 0;
  /// Returns the time by which a Doppler shift [Hz] displaces the peak of an echo [s].
  virtual double doppler_delay(const Pulse&, double) const { return 0; }

  /// Returns the time from its delay at which an echo ends for good [s].
  virtual double end(const Pulse&) const { return std::numeric_limits<double>::infinity(); }
  /// Returns the highest frequency off the carrier that matters to a series of this relative error, per bandwidth.
  virtual double relative_band(const Pulse& pulse, double tolerance) const = 0;
  /// Returns mean and deviation of the frequencies of an echo.
  virtual SpectrumMoments moments(const Pulse& pulse) const = 0;

 private:
  PulseTraits traits_;
};

/// Weights of a replica: w(t) = level + swing cos(2 pi t / T); level + swing = 1.
struct ReplicaWeights {
  double level, swing;
};

/// A signal exp(i phase(t)), |t| < T / 2, behind the filter that its replica matches. A kind states length and phase;
/// the rest follows, by sums over an echo where a kind has no closed form of its own.
class MatchedPulse : public PulseKind {
 public:
  using PulseKind::PulseKind;

  /// Returns the length T of the signal [s].
  virtual double length(const Pulse& pulse) const { return pulse.duration; }
  /// Returns the phase of the arriving signal at t [s] from its middle, after a Doppler shift [rad].
  virtual double phase(const Pulse& pulse, double t, double doppler) const = 0;
  /// Returns the length of the arriving signal [s].
  virtual double arriving_length(const Pulse& pulse, double) const { return length(pulse); }
  /// Returns the weights of the replica.
  virtual ReplicaWeights weights(const Pulse& pulse) const;
  /// Returns the frequency off the carrier beyond which absorption counts as there [Hz].
  virtual double edge(const Pulse& pulse) const { return 0.5 * pulse.bandwidth; }
  /// Returns `count` samples of the arriving signal times `step` [s], or of the replica at rest with its weights: cyclic
  /// from the middle on backwards, as the time dependence exp(-i omega t) has the opposite sign of a forward transform.
  std::vector<std::complex<double>> samples(const Pulse& pulse, std::size_t count, double step, bool weighted,
                                            double doppler) const;
  /// Returns the length: an echo ends as soon as signal and replica no longer overlap.
  double end(const Pulse& pulse) const override { return length(pulse); }

 protected:
  const MatchedPulse* matched() const override { return this; }
  double range_resolution(const Pulse& pulse, double sound_speed) const override;
  double energy_length(const Pulse& pulse, double sound_speed) const override;
  double half_length(const Pulse& pulse, double tolerance) const override;
  double noise_bandwidth(const Pulse& pulse) const override;
  double relative_band(const Pulse& pulse, double tolerance) const override;
  SpectrumMoments moments(const Pulse& pulse) const override;
};

/// Returns the kind of a shape.
inline const PulseKind& kind_of(PulseShape shape) { return pulse_kinds[static_cast<std::size_t>(shape)](); }
/// Returns the kind of a pulse.
inline const PulseKind& kind_of(const Pulse& pulse) { return kind_of(pulse.shape); }
/// Returns true if all echoes of a pulse are Gaussians (E8).
inline bool is_gaussian(const Pulse& pulse) { return kind_of(pulse).traits().gaussian; }

/// Returns the least absorption of the frequencies within `edge` [Hz] of the carrier [Np/m]. Throws Error if it is below
/// 0.
double least_absorption(const Absorption& absorption, double edge, const Pulse& pulse);

/// Returns Gauss-Hermite nodes of the spectrum |G(f)|^2, exact for polynomials of f up to the ninth degree. A Gaussian
/// pulse has a normal law of deviation B / sqrt(8 ln 2); others are replaced by one of their own mean and deviation.
inline std::array<SpectrumNode, 5> spectrum_nodes(const Pulse& pulse) {
  const auto [mean, s] = kind_of(pulse).moments(pulse);
  constexpr double far = 2.856970013872806, near = 1.355626179974266;
  return {{{mean - far * s, 0.011257411327720689},
           {mean - near * s, 0.2220759220056126},
           {mean, 0.5333333333333333},
           {mean + near * s, 0.2220759220056126},
           {mean + far * s, 0.011257411327720689}}};
}

}  // namespace insonify
