// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <vector>

#include "sonar/pulse.hpp"

namespace insonify {

/// A replica's weights: w(t) = level + swing cos(2 pi t / T); level + swing = 1.
struct ReplicaWeights {
  double level, swing;
};
ReplicaWeights replica_weights(ReplicaWindow window);

/// Gauss-Hermite rules of several sizes, smallest first: sum_m weight f(node) = (1/sqrt(pi)) integral exp(-h^2) f dh.
struct HermiteRules {
  struct Rule {
    std::vector<double> node, weight;
  };
  std::vector<Rule> rules;
  HermiteRules();
};

/// One echo of a sweep behind its matched filter (E54). The absorption's slope over the band is an exponential along
/// the sweep. Its curvature is a Gaussian, an average of exponentials (Gauss-Hermite). Each exponential gives an
/// integral in closed form.
class LinearFmEcho {
 public:
  LinearFmEcho(const Pulse& pulse, const Absorption& absorption, double range, double doppler,
               const HermiteRules* rules);
  std::complex<double> at(double t) const;

 private:
  /// The term weight exp(log_gain + slope tau) of the sweep's amplitude.
  struct Exponential {
    std::complex<double> log_gain, slope;
    double weight;
  };
  std::complex<double> lossless(double t) const;
  std::complex<double> lossy(double t) const;
  void add_losses(const Pulse& pulse, const Absorption& absorption, double range, const HermiteRules* rules);

  double duration_, rate_, doppler_;
  ReplicaWeights window_;
  double gain_;
  std::vector<Exponential> exponentials_;  ///< empty: the loss is the same at all frequencies
};

/// Returns the half width of a sweep's compressed intensity at half maximum [s] (E55).
double linear_fm_half_width(const Pulse& pulse);

/// Returns pulse_half_length of a sweep.
double linear_fm_half_length(const Pulse& pulse, double tolerance);

}  // namespace insonify
