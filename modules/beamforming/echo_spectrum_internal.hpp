#pragma once
#include <complex>
#include <cstddef>
#include <vector>

#include "acoustics/pulse.hpp"
#include "acoustics/water.hpp"
#include "beamforming/forward_fft_internal.hpp"

namespace insonify {

/// Frequencies f_k of a discrete Fourier transform, both signs, and its step in time.
struct FrequencyGrid {
  std::size_t samples = 0;
  double step_time = 0;

  double step() const { return 1 / (static_cast<double>(samples) * step_time); }
  double at(std::size_t k) const {
    const auto n = static_cast<std::ptrdiff_t>(samples), i = static_cast<std::ptrdiff_t>(k);
    return static_cast<double>(i < (n + 1) / 2 ? i : i - n) / (static_cast<double>(samples) * step_time);
  }
};

/// Spectrum of a Gaussian pulse in baseband, 1/Hz, integral 1: envelope peak 1 (E8).
double gaussian_spectrum(double f, double bandwidth);

/// Spectra of single echoes behind the receive filter [1/Hz], from the samples of sweep and replica by FFT, or for a
/// Gaussian by its own transform. A Doppler shift moves what was sent, after its losses on the way. Outside of its swept
/// band a sweep is absorbed as at the band's edge: absorption about a centre frequency means nothing far from it.
class EchoSpectrum {
 public:
  EchoSpectrum(const Pulse& pulse, const Medium& medium, const FrequencyGrid& grid);

  /// One value per frequency of the grid, for an echo at delay 0 after a way of `range` there and back.
  std::vector<std::complex<double>> of(double range, double doppler) const;

 private:
  std::vector<std::complex<double>> sweep_spectrum(bool weighted, double doppler) const;

  Pulse pulse_;
  Absorption absorption_;
  FrequencyGrid grid_;
  ForwardFft fft_;
  std::vector<std::complex<double>> sent_, replica_;
  double replica_area_ = 0;  ///< integral of its weights [s]
};

}  // namespace insonify
