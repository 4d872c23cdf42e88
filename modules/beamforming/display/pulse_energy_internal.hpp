// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <numbers>
#include <vector>

#include "sonar/pulse.hpp"
#include "sonar/pulse_kind.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// Energy, length, correlation and spectrum of a pulse after its way, from samples of its envelope G (E8, E54).
class PulseEnergy {
 public:
  /// Samples the envelopes of echoes from the ranges of `gate`. Throws Error as EchoShapes does.
  PulseEnergy(const Pulse& pulse, const Medium& medium, const RangeGate& gate);

  /// Returns the integral of |G|^2 over range [m] for an echo from `range` [m].
  double energy(double range) const {
    const double last = static_cast<double>(energy_.size() - 1);
    const double position = std::clamp((range - first_range_) * entries_per_metre_, 0.0, last);
    const auto left = std::min(static_cast<std::size_t>(position), energy_.size() - 2);
    return energy_[left] + (position - static_cast<double>(left)) * (energy_[left + 1] - energy_[left]);
  }
  /// Returns half the length [m] of the box with the variance of |G|^2 in range, in the middle of the gate.
  double half_length() const { return half_length_; }
  /// Returns the standard deviation of |G|^2 in range [m], there.
  double deviation() const { return half_length_ / std::numbers::sqrt3; }
  /// Returns the range that an echo is farther for each second of delay [m/s].
  double metres_per_s() const { return 0.5 * medium_.sound_speed; }
  /// Returns the squared magnitude of the correlation of white echoes `distance` [m] apart in range, 1 at 0.
  double correlation(double distance) const;
  /// Returns the spectrum |G(f)|^2 of an echo from `range` at `count` frequencies evenly over three half-widths of the
  /// band, normalised to a sum of 1.
  std::vector<SpectrumNode> spectrum(double range, std::size_t count) const;

 private:
  struct Samples {
    std::vector<std::complex<double>> value;  ///< samples of the envelope G
    double step = 0;                          ///< time between samples [s]
  };
  Samples samples_of(double range) const;
  void fill_energies(const RangeGate& gate, double metres_per_s);

  Pulse pulse_;
  Medium medium_;
  EchoShapes shapes_;
  double first_range_, entries_per_metre_ = 0;
  std::vector<double> energy_;  ///< at ranges so far apart
  double half_length_ = 0, correlation_step_ = 0;
  std::vector<double> correlation_;
};

}  // namespace insonify
