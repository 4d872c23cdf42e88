// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/numerics/beam_spectrum.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <complex>

#include "beamforming/numerics/fft_internal.hpp"
#include "core/error.hpp"
#include "core/require.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Complex = std::complex<double>;

std::size_t segment_length(const BeamSpectrumOptions& options, std::size_t samples) {
  if (options.segment != 0) return options.segment;
  return std::clamp<std::size_t>(std::bit_ceil(samples / 64 + 1), 64, 1024);
}

void require_series(const ComplexGridF& pressure, std::span<const std::size_t> beams, double step_time,
                    std::size_t segment) {
  constexpr const char* who = "beam_spectrum";
  if (beams.empty() || pressure.cols() == 0)
    fail(ErrorKind::argument, who, ": ", beams.size(), " beams of ", pressure.cols(), " samples, must be at least one");
  for (const std::size_t beam : beams)
    if (beam >= static_cast<std::size_t>(pressure.rows()))
      fail(ErrorKind::argument, who, ": beam = ", beam, ", must be below the number of beams, ", pressure.rows());
  require(step_time > 0 && std::isfinite(step_time), who, "step_time", step_time, "s", "finite and > 0");
  require(segment >= 2 && segment % 2 == 0, who, "options.segment", static_cast<double>(segment), "samples",
          "even and at least 2");
}

}  // namespace

BeamSpectrum beam_spectrum(const ComplexGridF& pressure, std::span<const std::size_t> beams, double step_time,
                           const BeamSpectrumOptions& options) {
  const auto samples = static_cast<std::ptrdiff_t>(pressure.cols());
  const std::size_t length = segment_length(options, static_cast<std::size_t>(samples));
  require_series(pressure, beams, step_time, length);
  const auto half = static_cast<std::ptrdiff_t>(length / 2);
  std::vector<double> window(length);
  for (std::size_t n = 0; n < length; ++n)
    window[n] = std::sin(pi * (static_cast<double>(n) + 0.5) / static_cast<double>(length));

  // Every sample is in two segments; the first and last segments extend half a segment beyond the series.
  const Fft<double> fft({length}, FFTW_FORWARD);
  std::vector<double> power(length, 0);
  std::vector<Complex> piece(length);
  for (const std::size_t beam : beams)
    for (std::ptrdiff_t first = -half; first < samples; first += half) {
      for (std::size_t n = 0; n < length; ++n) {
        const std::ptrdiff_t at = first + static_cast<std::ptrdiff_t>(n);
        const bool inside = at >= 0 && at < samples;
        piece[n] = inside ? window[n] * Complex(pressure(static_cast<Eigen::Index>(beam), at)) : Complex(0);
      }
      fft.run(piece.data());
      for (std::size_t k = 0; k < length; ++k) power[k] += std::norm(piece[k]);
    }

  // The time dependence is exp(-i omega t), so entry k of the transform belongs to frequency -k.
  BeamSpectrum spectrum;
  const double scale = step_time / (2 * static_cast<double>(samples) * static_cast<double>(beams.size()));
  for (std::ptrdiff_t k = -half; k < half; ++k) {
    const std::ptrdiff_t entry = (2 * half - k) % (2 * half);
    spectrum.frequency.push_back(options.centre_frequency +
                                 static_cast<double>(k) / (static_cast<double>(length) * step_time));
    spectrum.density.push_back(scale * power[static_cast<std::size_t>(entry)]);
  }
  return spectrum;
}

std::vector<double> pulse_density(const Pulse& pulse, double step_time, const std::vector<double>& frequency,
                                  double mean_square_pressure) {
  constexpr const char* who = "pulse_density";
  if (frequency.size() < 2 || !(frequency[1] > frequency[0]))
    fail(ErrorKind::argument, who, ": ", frequency.size(), " frequencies, must be at least 2 and ascend");
  const double step = frequency[1] - frequency[0];
  for (std::size_t k = 1; k < frequency.size(); ++k)
    if (!(std::abs(frequency[k] - frequency[k - 1] - step) <= 1e-6 * step))
      fail(ErrorKind::argument, who, ": frequency[", k, "] = ", frequency[k], " Hz, must be evenly spaced");

  require(step_time > 0 && std::isfinite(step_time), who, "step_time", step_time, "s", "finite and > 0");

  constexpr int positions = 8;  // positions between two samples: aliases of up to seven bands average out exactly
  const EchoEnvelope envelope = echo_envelope(pulse, {}, 0);
  const int reach = positions * static_cast<int>(std::ceil(pulse_half_length(pulse, 1e-8) / step_time));
  std::vector<Complex> samples;
  for (int n = -reach; n < reach; ++n) samples.push_back(envelope.at(n * step_time / positions));

  std::vector<double> density;
  double sum = 0;
  for (const double f : frequency) {
    std::array<Complex, positions> transform{};
    for (int n = -reach; n < reach; ++n) {
      const auto i = static_cast<std::size_t>(n + reach);
      const double cycles = reduced_cycles((f - pulse.centre_frequency) * step_time * n / positions);
      transform[i % positions] += samples[i] * std::polar(1.0, 2 * pi * cycles);
    }
    density.push_back(0);
    for (const Complex& t : transform) density.back() += std::norm(t);
    sum += density.back();
  }
  for (double& d : density) d *= mean_square_pressure / (sum * step);
  return density;
}

}  // namespace insonify
