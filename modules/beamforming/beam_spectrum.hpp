#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "acoustics/pulse.hpp"
#include "core/grid.hpp"

namespace insonify {

/// Power spectral density about a centre frequency.
struct BeamSpectrum {
  std::vector<double> frequency;  ///< [Hz], ascending: centre_frequency +- half the sampling rate
  std::vector<double> density;    ///< [Pa^2/Hz]
};

struct BeamSpectrumOptions {
  double centre_frequency = 0;  ///< [Hz]
  std::size_t segment = 0;      ///< samples per segment, even; 0: a power of two near a 64th of the series, 64 to 1024
};

/// Power spectral density of the complex baseband series of some beams, averaged over these beams and over time:
///
///   S(fc + f_k) = step / (2 N beams) sum_beams sum_s |sum_n w(n) p(n + s L/2) exp(+2 pi i f_k step n)|^2,
///   w(n) = sin(pi (n + 1/2) / L),  f_k = k / (L step),  k = -L/2 .. L/2 - 1
///
/// over half overlapping segments s of L samples each, the series being silent before its first sample and after its
/// last. Squares of overlapping windows add up to one, so that the sum of S / (L step) is the mean of |p|^2 / 2, the mean
/// square pressure, whatever the segment (Parseval, to rounding). A segment resolves 1.2 / (L step).
///
/// pressure   beams x samples [Pa], analytic, turning as exp(-i omega t)
/// beams      rows that count, at least one
/// step_time  between samples [s], two-way
///
/// Throws Error(argument) if there is no beam or sample, a beam is not there, step_time is not > 0, or the segment is odd
/// or below 2.
BeamSpectrum beam_spectrum(const ComplexGridF& pressure, std::span<const std::size_t> beams, double step_time,
                           const BeamSpectrumOptions& options = {});

/// Power spectral density of pulses as they leave the receiver's filter, without loss (E8, E54), at the same frequencies:
///
///   S(f) = c mean_d |sum_n G((n + d) step) exp(+2 pi i (f - fc) (n + d) step)|^2
///
/// the envelope G sampled step_time apart and averaged over its place d between two samples, since echoes arrive at any
/// time: what sampling folds into the band is in, as it is in the series. Scaled so that the sum of S times the spacing
/// of the frequencies is the given mean square pressure [Pa^2]. Of a Gaussian it is c sum_m exp(-4 ln2 (f - fc + m /
/// step)^2 / B^2), to 1e-6 of its peak. Throws Error for an invalid pulse, a step_time that is not > 0, fewer than two
/// frequencies, or ones not evenly spaced and ascending.
std::vector<double> pulse_density(const Pulse& pulse, double step_time, const std::vector<double>& frequency,
                                  double mean_square_pressure);

}  // namespace insonify
