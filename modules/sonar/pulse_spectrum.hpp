// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>

#include "sonar/pulse.hpp"

namespace insonify {

/// A frequency off the carrier [Hz], and its fraction of a pulse's energy.
struct SpectrumNode {
  double frequency, weight;
};

/// Returns Gauss-Hermite nodes of the spectrum |G(f)|^2, exact for polynomials of f up to the ninth degree. A Gaussian
/// pulse has a normal law of deviation B / sqrt(8 ln 2); a sweep is replaced by one of its own deviation, B / sqrt(12).
inline std::array<SpectrumNode, 5> spectrum_nodes(const Pulse& pulse) {
  const double s = pulse.bandwidth * (pulse.shape == PulseShape::gaussian ? 0.424660900144 : 0.288675134595);
  constexpr double far = 2.856970013872806, near = 1.355626179974266;
  return {{{-far * s, 0.011257411327720689},
           {-near * s, 0.2220759220056126},
           {0, 0.5333333333333333},
           {near * s, 0.2220759220056126},
           {far * s, 0.011257411327720689}}};
}

}  // namespace insonify
