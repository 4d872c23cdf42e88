#pragma once
#include <complex>
#include <cstddef>
#include <vector>

#include "acoustics/pulse.hpp"
#include "acoustics/water.hpp"
#include "beamforming/forward_fft_internal.hpp"

namespace insonify {

/// Frequencies f_k of a discrete Fourier transform, of both signs, and its sampling interval [s].
struct FrequencyGrid {
  std::size_t samples = 0;
  double step_time = 0;

  double step() const { return 1 / (static_cast<double>(samples) * step_time); }
  double at(std::size_t k) const {
    const auto n = static_cast<std::ptrdiff_t>(samples), i = static_cast<std::ptrdiff_t>(k);
    return static_cast<double>(i < (n + 1) / 2 ? i : i - n) / (static_cast<double>(samples) * step_time);
  }
};

/// Returns the baseband spectrum of a Gaussian pulse [1/Hz] with integral 1, i.e. envelope peak 1 (E8).
double gaussian_spectrum(double f, double bandwidth);

/// Computes spectra of single echoes after the receive filter [1/Hz]: by FFT of the samples of sweep and replica, or in
/// closed form for a Gaussian. A Doppler shift moves the transmitted spectrum, after its absorption. Outside its swept
/// band a sweep is absorbed as at the band edge, since the expansion of the absorption about the centre frequency does
/// not hold there.
class EchoSpectrum {
 public:
  EchoSpectrum(const Pulse& pulse, const Medium& medium, const FrequencyGrid& grid);

  /// Returns one value per frequency of the grid, for an echo at delay 0 from one-way range `range` [m] with Doppler
  /// shift `doppler` [Hz].
  std::vector<std::complex<double>> of(double range, double doppler) const;

 private:
  std::vector<std::complex<double>> sweep_spectrum(bool weighted, double doppler) const;

  Pulse pulse_;
  Absorption absorption_;
  FrequencyGrid grid_;
  ForwardFft fft_;
  std::vector<std::complex<double>> sent_, replica_;
  double replica_area_ = 0;  ///< integral of the replica's weights [s]
};

}  // namespace insonify
