// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "beamforming/numerics/fft_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/synthesize.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
namespace {

using Complex = std::complex<double>;

/// Frequency grid of the sum: M equally spaced frequencies of both signs over `oversampling` times the sampling rate of
/// the output, wide enough for the pulse, with a time window that contains every echo and its pulse, so nothing wraps
/// around.
struct SpectrumGrid {
  std::size_t oversampling = 1, samples = 0;
  std::size_t skipped = 0;  ///< output bins before the first of the gate
  double step_time = 0, start_time = 0;

  SpectrumGrid(const Echoes& echoes, const SonarHead& head, const Medium& medium) {
    const double bin_time = 2 * head.gate.bin_size / medium.sound_speed;
    // At +-5 B the spectrum of a Gaussian is down to e^-34, 1e-15 of its peak; others decay more slowly.
    const double band = (is_gaussian(head.pulse) ? 10 : 64) * head.pulse.bandwidth;
    oversampling = static_cast<std::size_t>(std::ceil(band * bin_time));
    step_time = bin_time / static_cast<double>(oversampling);
    const double guard = 2 * pulse_half_length(head.pulse, 1e-16);
    const double first_time = 2 * head.gate.centre(0) / medium.sound_speed;
    double earliest = first_time, latest = 2 * head.gate.max_range / medium.sound_speed;
    for (const double delay : echoes.delay) earliest = std::min(earliest, delay), latest = std::max(latest, delay);
    skipped = static_cast<std::size_t>(std::ceil((first_time - earliest + guard) / bin_time));
    start_time = first_time - static_cast<double>(skipped) * bin_time;
    const double wanted = std::ceil((latest + guard - start_time) / step_time) + 1;
    if (!(wanted <= 0x1p26))
      fail(ErrorKind::argument, "synthesize_spectrum: echoes between ", earliest, " and ", latest, " s and a pulse of ",
           guard, " s need ", wanted, " samples, must be at most 2^26; use another method");
    samples = static_cast<std::size_t>(wanted);
  }

  double step() const { return 1 / (static_cast<double>(samples) * step_time); }
  double at(std::size_t k) const {
    const auto n = static_cast<std::ptrdiff_t>(samples), i = static_cast<std::ptrdiff_t>(k);
    return static_cast<double>(i < (n + 1) / 2 ? i : i - n) / (static_cast<double>(samples) * step_time);
  }
};

/// Returns the baseband spectrum of a Gaussian pulse [1/Hz] with integral 1, i.e. envelope peak 1 (E8).
double gaussian_spectrum(double f, double bandwidth) {
  const double x = f / bandwidth;
  return std::exp(-2 * std::numbers::ln2 * x * x) * std::sqrt(2 * std::numbers::ln2 / pi) / bandwidth;
}

/// Computes spectra of single echoes after the receive filter [1/Hz]: by FFT of the samples of signal and replica, or in
/// closed form for a Gaussian. A Doppler shift moves the transmitted spectrum, after its absorption. Beyond the edge of
/// its band a signal is absorbed as there, since the expansion of the absorption about the centre frequency does not
/// hold there.
class EchoSpectrum {
 public:
  EchoSpectrum(const Pulse& pulse, const Medium& medium, const SpectrumGrid& grid)
      : pulse_(pulse),
        matched_(kind_of(pulse).matched()),
        absorption_(medium.absorption),
        grid_(grid),
        fft_({grid.samples}, FFTW_FORWARD) {
    if (!matched_) return;
    sent_ = transform(false, 0);
    replica_ = transform(true, 0);
    const double length = matched_->length(pulse);
    replica_area_ = length * replica_weight(pulse, 0.25 * length);  // the weight at T/4 equals its mean
  }

  /// Returns one value per frequency of the grid, for an echo at delay 0 from one-way range `range` [m] with Doppler
  /// shift `doppler` [Hz].
  std::vector<Complex> of(double range, double doppler) const {
    std::vector<Complex> x(grid_.samples);
    if (matched_) x = doppler == 0 ? sent_ : transform(false, doppler);
    const double edge = matched_ ? matched_->edge(pulse_) : std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double sent = grid_.at(k) - doppler, f = std::clamp(sent, -edge, edge);
      const double alpha = absorption_.a0 + f * (absorption_.a1 + f * absorption_.a2);
      const double loss = std::exp(-2 * alpha * range);
      x[k] = matched_ ? loss / replica_area_ * x[k] * std::conj(replica_[k])
                      : loss * gaussian_spectrum(sent, pulse_.bandwidth);
    }
    return x;
  }

 private:
  std::vector<Complex> transform(bool weighted, double doppler) const {
    std::vector<Complex> x = matched_->samples(pulse_, grid_.samples, grid_.step_time, weighted, doppler);
    fft_.run(x.data());
    return x;
  }

  Pulse pulse_;
  const MatchedPulse* matched_;  ///< nullptr: Gaussian
  Absorption absorption_;
  SpectrumGrid grid_;
  Fft<double> fft_;
  std::vector<Complex> sent_, replica_;
  double replica_area_ = 0;  ///< integral of the replica's weights [s]
};

/// Spectra of all beams, beams x frequencies [1/Hz]:
///   S_b(f) = sum_i A_i B_b(u_i) exp(+2 pi i f (delay - start)) G_i(f).
ComplexGrid beam_spectra(const Echoes& echoes, const SonarHead& head, const Medium& medium, const SpectrumGrid& grid,
                         const std::vector<double>& u_beam, int threads) {
  const double wavelength = medium.sound_speed / head.pulse.centre_frequency;
  const EchoSpectrum shapes(head.pulse, medium, grid);
  ComplexGrid spectra = ComplexGrid::Zero(u_beam.size(), grid.samples);
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    std::vector<Complex> echo = shapes.of(0.5 * medium.sound_speed * echoes.delay[i], echoes.doppler_of(i));
    for (std::size_t k = 0; k < grid.samples; ++k)
      echo[k] *= std::polar(grid.step(), 2 * pi * reduced_cycles(grid.at(k) * (echoes.delay[i] - grid.start_time)));
    parallel_for(u_beam.size(), threads, [&](std::size_t b) {
      const Complex weight = echoes.amplitude[i] * array_response(head.array, wavelength, echoes.u[i], u_beam[b]);
      for (std::size_t k = 0; k < grid.samples; ++k) spectra(b, k) += weight * echo[k];
    });
  }
  return spectra;
}

}  // namespace

ComplexGrid synthesize_spectrum(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                const SynthesisOptions& options) {
  require_synthesis(echoes, head, medium, options, "synthesize_spectrum");
  require_one_row(head, "synthesize_spectrum");
  const SpectrumGrid grid(echoes, head, medium);
  const std::vector<double> u_beam = beam_cosines(head.fan);
  ComplexGrid spectra = beam_spectra(echoes, head, medium, grid, u_beam, options.threads);
  ComplexGrid pressure(u_beam.size(), head.gate.bins());

  const Fft<double> fft({grid.samples}, FFTW_FORWARD);
  parallel_for(u_beam.size(), options.threads, [&](std::size_t b) {
    const std::span<Complex> spectrum(&spectra(b, 0), grid.samples);
    fft.run(spectrum.data());  // p(t) = sum_k P(f_k) exp(-2 pi i f_k t)
    for (std::size_t n = 0; n < head.gate.bins(); ++n)
      pressure(b, n) = spectrum[(n + grid.skipped) * grid.oversampling];
  });
  return pressure;
}

}  // namespace insonify
