// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "core/grid.hpp"
#include "sonar/pulse.hpp"

namespace insonify {

/// Power spectral density around a centre frequency.
struct BeamSpectrum {
  std::vector<double> frequency;  ///< [Hz], ascending: centre_frequency +- half the sampling rate
  std::vector<double> density;    ///< [Pa^2/Hz]
};

/// Options of beam_spectrum.
struct BeamSpectrumOptions {
  double centre_frequency = 0;  ///< [Hz]
  std::size_t segment = 0;      ///< samples per segment, even; 0: a power of two near a 64th of the series, 64 to 1024
};

/// Returns the power spectral density of the complex baseband series of `beams`, averaged over beams and time:
///
///   S(fc + f_k) = step / (2 N beams) sum_beams sum_s |sum_n w(n) p(n + s L/2) exp(+2 pi i f_k step n)|^2,
///   w(n) = sin(pi (n + 1/2) / L),  f_k = k / (L step),  k = -L/2 .. L/2 - 1
///
/// over half-overlapping segments s of L samples each (Welch 1967). The series is zero-padded at both ends. The squares
/// of overlapping windows add up to one, so for every segment length the sum of S / (L step) is the mean square
/// pressure, mean |p|^2 / 2 (Parseval, to rounding). The -3 dB resolution is 1.2 / (L step).
///
/// pressure   beams x samples [Pa], analytic, time dependence exp(-i omega t)
/// beams      rows to average, at least one
/// step_time  sampling interval [s], two-way time
///
/// Throws Error(argument) if there is no beam or sample, a beam does not exist, step_time is not > 0, or the segment is
/// odd or below 2.
BeamSpectrum beam_spectrum(const ComplexGridF& pressure, std::span<const std::size_t> beams, double step_time,
                           const BeamSpectrumOptions& options = {});

/// Returns the power spectral density of pulses after the receive filter, without propagation loss (E8, E54), at the
/// given frequencies:
///
///   S(f) = c mean_d |sum_n G((n + d) step) exp(+2 pi i (f - fc) (n + d) step)|^2
///
/// The envelope G is sampled at intervals step_time. The mean is over the offset d of the pulse between two samples,
/// because echoes arrive at any time. Aliasing is included, as in the series. The factor c is such that the sum of S
/// times the frequency spacing is mean_square_pressure [Pa^2]. For a Gaussian pulse the result is c sum_m exp(-4 ln2 (f
/// - fc + m / step)^2 / B^2), accurate to 1e-6 of its peak. Throws Error for an invalid pulse, a step_time that is not
/// > 0, fewer than two frequencies, or frequencies that are not ascending and equally spaced.
std::vector<double> pulse_density(const Pulse& pulse, double step_time, const std::vector<double>& frequency,
                                  double mean_square_pressure);

}  // namespace insonify
