// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/numerics/beam_spectrum.hpp"

#include "core/random.hpp"
#include "support/test.hpp"

namespace {

constexpr double chirp_band = 187.5e3, step_time = 0.44 / chirp_band;

ComplexGridF noise(Eigen::Index beams, Eigen::Index samples) {
  ComplexGridF series(beams, samples);
  for (Eigen::Index b = 0; b < beams; ++b)
    for (Eigen::Index n = 0; n < samples; ++n)
      series(b, n) = std::complex<float>(random_complex_normal(
          7, RandomStage::noise, {0, static_cast<std::uint64_t>(b), static_cast<std::uint64_t>(n)}));
  return series;
}

double total(const BeamSpectrum& spectrum) {
  return std::accumulate(spectrum.density.begin(), spectrum.density.end(), 0.0) *
         (spectrum.frequency[1] - spectrum.frequency[0]);
}

double mean_square(const ComplexGridF& series) {
  double power = 0;
  for (const std::complex<float>& p : series.reshaped()) power += std::norm(std::complex<double>(p));
  return power / 2 / static_cast<double>(series.size());
}

// Returns a line exp(-i 2 pi f t).
ComplexGridF tone(double f, Eigen::Index samples) {
  ComplexGridF series(1, samples);
  for (Eigen::Index n = 0; n < samples; ++n)
    series(0, n) = std::complex<float>(std::polar(1.0, -2 * pi * f * step_time * static_cast<double>(n)));
  return series;
}

// Returns the spectrum of a Gaussian with aliasing, relative to its peak.
double folded_gaussian(double f) {
  double sum = 0;
  for (int fold = -4; fold <= 4; ++fold) {
    const double x = (f + fold / step_time) / chirp_band;
    sum += std::exp(-4 * std::numbers::ln2 * x * x);
  }
  return sum;
}

}  // namespace

// Parseval, for segments that divide the series, do not divide it, or are longer.
TEST(BeamSpectrum, adds_up_to_the_mean_square_pressure) {
  const ComplexGridF series = noise(3, 1001);
  const std::size_t all[] = {0, 1, 2};
  for (const std::size_t segment : {0, 2, 64, 250, 4096})
    EXPECT_NEAR(total(beam_spectrum(series, all, step_time, {0, segment})) / mean_square(series), 1, 1e-12) << segment;
  const std::size_t one[] = {1};
  EXPECT_NEAR(total(beam_spectrum(series, one, step_time)) / mean_square(series.row(1)), 1, 1e-12);
}

// White noise of unit power: half its power over the band of 1 / step_time. 64 segments and 40 beams leave an error of
// about 1 / sqrt(2500) each.
TEST(BeamSpectrum, of_white_noise_is_flat) {
  const ComplexGridF series = noise(40, 2048);
  std::vector<std::size_t> all(40);
  std::iota(all.begin(), all.end(), 0);
  const double expected = mean_square(series) * step_time;
  for (const double density : beam_spectrum(series, all, step_time, {0, 64}).density)
    EXPECT_NEAR(density / expected, 1, 0.12);
}

// exp(-i omega t): a positive Doppler shift is a higher frequency.
TEST(BeamSpectrum, has_a_line_at_its_own_frequency) {
  const double spacing = 1 / (256 * step_time);
  for (const int k : {-100, -1, 0, 37, 127}) {
    const std::size_t beam[] = {0};
    const BeamSpectrum spectrum = beam_spectrum(tone(k * spacing, 4096), beam, step_time, {750e3, 256});
    const auto highest = std::max_element(spectrum.density.begin(), spectrum.density.end());
    EXPECT_NEAR(spectrum.frequency[static_cast<std::size_t>(highest - spectrum.density.begin())], 750e3 + k * spacing,
                1e-6 * spacing);
  }
}

// (E8): half the power at fc +- B/2. A segment long compared with the pulse broadens it by less than 1 %.
TEST(BeamSpectrum, of_a_gaussian_pulse_is_as_wide_as_its_bandwidth) {
  ComplexGridF series = ComplexGridF::Zero(1, 2048);
  const Pulse pulse{750e3, chirp_band, 220};
  const EchoEnvelope envelope = echo_envelope(pulse, {}, 0);
  const double fine = step_time / 4;  // no aliasing
  for (Eigen::Index n = 0; n < 2048; ++n)
    series(0, n) = std::complex<float>(envelope.at((static_cast<double>(n) - 1017.3) * fine));
  const std::size_t beam[] = {0};
  const BeamSpectrum spectrum = beam_spectrum(series, beam, fine, {750e3, 1024});
  const double peak = *std::max_element(spectrum.density.begin(), spectrum.density.end());
  for (std::size_t k = 0; k < spectrum.frequency.size(); ++k) {
    const double x = (spectrum.frequency[k] - 750e3) / chirp_band;
    if (std::abs(x) > 1.2) continue;
    EXPECT_NEAR(spectrum.density[k] / peak / std::exp(-4 * std::numbers::ln2 * x * x), 1, 0.01) << x;
  }
}

TEST(PulseDensity, of_a_gaussian_is_the_closed_form_with_aliasing) {
  const std::size_t beam[] = {0};
  const std::vector<double> frequency = beam_spectrum(noise(1, 400), beam, step_time, {750e3, 64}).frequency;
  const std::vector<double> density = pulse_density({750e3, chirp_band, 220}, step_time, frequency, 3.5);
  double sum = 0;
  for (const double d : density) sum += d;
  EXPECT_NEAR(sum * (frequency[1] - frequency[0]), 3.5, 1e-12);
  const double peak = density[32];
  for (std::size_t k = 0; k < density.size(); ++k)
    EXPECT_NEAR(density[k] / peak, folded_gaussian(frequency[k] - 750e3) / folded_gaussian(0), 1e-6) << k;
}

// A sweep of large time-chirp_band product fills its band evenly under a uniform replica, and nothing else: half the
// power at the band's edges, little beyond.
TEST(PulseDensity, of_a_sweep_fills_its_band) {
  const Pulse sweep{100e3, 20e3, 220, PulseShape::linear_fm, 0.02, ReplicaWindow::uniform};
  std::vector<double> frequency;
  for (int k = -64; k < 64; ++k) frequency.push_back(100e3 + k * 45e3 / 128);
  const std::vector<double> density = pulse_density(sweep, 1 / 45e3, frequency, 1);
  const double inside = density[64];
  for (std::size_t k = 0; k < frequency.size(); ++k) {
    const double off = std::abs(frequency[k] - 100e3);
    if (off < 8e3) {
      EXPECT_NEAR(db_from_power(density[k] / inside), 0, 1.5) << frequency[k];
    } else if (off > 12e3) {
      EXPECT_LT(db_from_power(density[k] / inside), -20) << frequency[k];
    }
  }
}

TEST(BeamSpectrum, refuses_invalid_series) {
  const ComplexGridF series = noise(2, 100);
  const std::size_t none[] = {2}, one[] = {0};
  EXPECT_EQ(error_of([&] { beam_spectrum(series, none, step_time); }),
            "beam_spectrum: beam = 2, must be below the number of beams, 2");
  EXPECT_EQ(error_of([&] { beam_spectrum(series, {}, step_time); }),
            "beam_spectrum: 0 beams of 100 samples, must be at least one");
  EXPECT_EQ(error_of([&] { beam_spectrum(series, one, 0); }), "beam_spectrum: step_time = 0 s, must be finite and > 0");
  EXPECT_EQ(error_of([&] {
              beam_spectrum(series, one, step_time, {0, 7});
            }),
            "beam_spectrum: options.segment = 7 samples, must be even and at least 2");
  EXPECT_EQ(error_of([&] {
              pulse_density({750e3, chirp_band, 220}, step_time, {1, 2, 4}, 1);
            }),
            "pulse_density: frequency[2] = 4 Hz, must be evenly spaced");
}
