// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/pulse.hpp"

#include "support/test.hpp"

namespace {
const Pulse p900{900e3, 29.5e3, 220};
}

// 220 dB re 1 uPa rms is 1e5 Pa rms, 1.414e5 Pa peak.
TEST(Pulse, source_pressure_is_a_peak_value) { EXPECT_NEAR(source_pressure(p900), 141421.356237, 1e-5); }

// 0.4413 c / 2B: 29.5 kHz gives 1.12 cm at 1500 m/s.
TEST(Pulse, range_resolution_is_the_intensity_fwhm) {
  EXPECT_NEAR(range_resolution(p900, 1500), 0.01122, 1e-5);
  const EchoEnvelope e = echo_envelope(p900, {}, 10);
  const double t = range_resolution(p900, 1500) / 1500;  // half the width, as two-way time
  EXPECT_NEAR(std::norm(e.at(t)), 0.5, 1e-6);
}

TEST(Pulse, envelope_peaks_at_one_and_falls_to_the_tolerance_at_the_half_length) {
  const EchoEnvelope e = echo_envelope(p900, {}, 10);
  EXPECT_DOUBLE_EQ(e.at(0).real(), 1);
  for (const double tolerance : {1e-2, 1e-6, 1e-12})
    EXPECT_NEAR(std::abs(e.at(pulse_half_length(p900, tolerance))), tolerance, 1e-9 * tolerance);
}

// Numerical inverse transform of S(f) exp(-2 alpha(f) r) on a fine grid against the closed form.
TEST(Pulse, closed_form_with_frequency_dependent_absorption_matches_quadrature) {
  const Pulse wide{900e3, 295e3, 220};
  const Absorption a = absorption_about({}, wide.centre_frequency, 2);
  const double r = 60, df = 100;
  const EchoEnvelope envelope = echo_envelope(wide, a, r);
  for (const double t : {-2e-6, 0.0, 1e-6, 4e-6}) {
    std::complex<double> sum = 0;
    for (double f = -8 * wide.bandwidth; f <= 8 * wide.bandwidth; f += df) {
      const double x = f / wide.bandwidth;
      const double spectrum =
          std::exp(-2 * std::numbers::ln2 * x * x) * std::sqrt(2 * std::numbers::ln2 / pi) / wide.bandwidth;
      const double loss = std::exp(-2 * (a.a0 + a.a1 * f + a.a2 * f * f) * r);
      sum += std::polar(spectrum * loss * df, -2 * pi * f * t);
    }
    EXPECT_LT(std::abs(envelope.at(t) - sum), 1e-9 * std::abs(envelope.at(0))) << "t = " << t;
  }
}

TEST(Pulse, refuses_a_bandwidth_that_reaches_negative_frequencies) {
  EXPECT_THROW(require_valid(Pulse{900e3, 1.8e6, 220}, "test"), Error);
  EXPECT_THROW(require_valid(Pulse{900e3, 0, 220}, "test"), Error);
  EXPECT_THROW(pulse_half_length(p900, 0), Error);
}

// Slope and curvature make exp(b^2 / 4a) overflow where exp(-2 a0 r) underflows: together they are a number.
TEST(Pulse, envelope_under_absorption_that_varies_over_the_band_is_finite) {
  const Pulse wide{1e6, 0.9e6, 220};
  for (const double a0 : {0.03, 1.0, 10.0, 100.0}) {
    const Absorption square_law{a0, 2 * a0 / 1e6, a0 / 1e12};  // alpha proportional to f^2
    const EchoEnvelope e = echo_envelope(wide, square_law, 100);
    for (const double t : {-1e-6, 0.0, 1e-7})
      EXPECT_TRUE(std::isfinite(std::abs(e.at(t)))) << a0 << " Np/m, " << t << " s";
    // Least attenuated is the lowest frequency: the level falls far less than at the centre frequency.
    EXPECT_LT(std::abs(e.at(0)), 1) << a0;
    EXPECT_GT(std::abs(e.at(0)), std::exp(-2 * a0 * 100)) << a0;
  }
}
