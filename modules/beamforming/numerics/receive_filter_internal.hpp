// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <cstddef>
#include <vector>

#include "sonar/pulse.hpp"

namespace insonify {

/// The filter of a receiver at samples so far apart, of unit energy, through which noise passes: of a Gaussian pulse
/// real taps, else complex taps of a matched filter (E41, E55, E204).
struct ReceiveFilter {
  std::vector<double> real;
  std::vector<std::complex<double>> complex;

  /// Makes the taps for samples `step` [s] apart.
  ReceiveFilter(const Pulse& pulse, double step);
  std::size_t size() const { return real.size() + complex.size(); }
  /// Returns a sample of the noise from `size()` samples of white noise.
  std::complex<double> of(const std::complex<double>* white) const {
    std::complex<double> x = 0;
    for (std::size_t k = 0; k < real.size(); ++k) x += real[k] * white[k];
    for (std::size_t k = 0; k < complex.size(); ++k) x += complex[k] * white[k];
    return x;
  }
};

}  // namespace insonify
