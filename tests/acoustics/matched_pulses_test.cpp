// SPDX-License-Identifier: BSD-3-Clause
// Tone bursts and hyperbolic sweeps against their closed forms, and against the correlation of samples with the replica.
#include "sonar/pulse_kind.hpp"
#include "support/errors.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace insonify::matched_pulses_tests {

using Complex = std::complex<double>;

const Pulse burst{100e3, 10e3, 220, PulseShape::tone_burst};

/// A sweep of a mine hunter: 60 to 120 kHz.
Pulse hunter(double time_bandwidth, ReplicaWindow window) {
  return {90e3, 60e3, 220, PulseShape::hyperbolic_fm, time_bandwidth / 60e3, window};
}

/// Returns an echo at rest or moving by the sum of its definition, in steps of 1 / `per_period` of the bandwidth: the
/// signal stretched by 1 + doppler / centre frequency, or turned by the shift, times the conjugate replica.
template <typename Received, typename Replica>
Complex correlated(double length, double t, double stretch, double step, Received received, Replica replica) {
  const double low = std::max(-0.5 * length / stretch, t - 0.5 * length);
  const double high = std::min(0.5 * length / stretch, t + 0.5 * length);
  if (high <= low) return 0;
  const auto parts = static_cast<int>(std::ceil((high - low) / step));
  const double width = (high - low) / parts;
  Complex sum = 0;
  for (int k = 0; k < parts; ++k) {
    const double tau = low + (k + 0.5) * width;
    sum += width * received(tau) * std::conj(replica(tau - t));
  }
  return sum;
}

/// Phase of a hyperbolic sweep [rad] from its definition: frequency 1 / p, p from 1 / f_1 to 1 / f_2 evenly.
double hyperbolic_phase(const Pulse& pulse, double t) {
  const double p1 = 1 / (pulse.centre_frequency - pulse.bandwidth / 2),
               p2 = 1 / (pulse.centre_frequency + pulse.bandwidth / 2), q = (p2 - p1) / pulse.duration;
  return 2 * pi / q * std::log(0.5 * (p1 + p2) + q * t);
}

Complex hyperbolic_echo(const Pulse& pulse, double t, double doppler) {
  const double stretch = 1 + doppler / pulse.centre_frequency, carrier = 2 * pi * pulse.centre_frequency;
  const auto signal = [&](double tau) {
    return std::polar(1.0, carrier * tau - hyperbolic_phase(pulse, stretch * tau));
  };
  const auto replica = [&](double tau) {
    return std::polar(replica_weight(pulse, tau), carrier * tau - hyperbolic_phase(pulse, tau));
  };
  const double level = replica_weight(pulse, pulse.duration / 4);
  return correlated(pulse.duration, t, stretch, 0.01 / pulse.bandwidth, signal, replica) / (level * pulse.duration);
}

/// Returns the highest level of an echo and its time, from samples a hundredth of a period of the bandwidth apart.
std::pair<double, double> peak_of(const EchoEnvelope& echo, double from, double to, double bandwidth) {
  std::pair<double, double> best{0, 0};
  for (double t = from; t < to; t += 0.01 / bandwidth)
    if (std::abs(echo.at(t)) > best.first) best = {std::abs(echo.at(t)), t};
  return best;
}

TEST(ToneBurst, echo_is_the_triangle_of_its_autocorrelation) {
  const double length = 1 / burst.bandwidth;
  for (const double doppler : {0.0, 700.0, -4000.0}) {
    const EchoEnvelope echo = EchoShapes(burst, {c0, {0.01, 0, 0}}).of(2 * 25 / c0, doppler);
    const auto signal = [&](double tau) { return std::polar(1.0, -2 * pi * doppler * tau); };
    for (double t = -1.1 * length; t < 1.1 * length; t += 0.0137 * length) {
      const Complex sum = correlated(length, t, 1, 1e-4 * length, signal, [](double) { return Complex(1); }) / length;
      EXPECT_LT(std::abs(echo.at(t) - std::exp(-0.5) * sum), 1e-6) << t;
      if (doppler == 0) {
        EXPECT_NEAR(std::abs(echo.at(t)), std::exp(-0.5) * std::max(0.0, 1 - std::abs(t) / length), 1e-12);
      }
    }
  }
}

TEST(ToneBurst, spectrum_is_a_sinc) {
  const double length = 1 / burst.bandwidth, step = length / 400;
  const std::vector<Complex> x = kind_of(burst).matched()->samples(burst, 4000, step, false, 0);
  for (const double f : {0.0, 0.3, 0.9, 1.4, 2.5, 4.5}) {
    Complex sum = 0;
    for (std::size_t n = 0; n < x.size(); ++n)
      sum += x[n] * std::polar(1.0, -2 * pi * f / length * step * static_cast<double>(n));
    EXPECT_NEAR(sum.real() / length, f == 0 ? 1 : std::sin(pi * f) / (pi * f), 3e-5) << f;
    EXPECT_NEAR(sum.imag() / length, 0, 1e-9);
  }
}

TEST(ToneBurst, widths_are_those_of_the_triangle) {
  const double length = 1 / burst.bandwidth;
  EXPECT_DOUBLE_EQ(nominal_range_resolution(burst, c0), c0 * length / 2);
  EXPECT_DOUBLE_EQ(range_resolution(burst, c0), c0 * length / 2 * (2 - std::sqrt(2.0)));
  EXPECT_NEAR(std::norm(echo_envelope(burst, {}, 0).at(range_resolution(burst, c0) / c0)), 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(noise_bandwidth(burst), burst.bandwidth);
  double energy = 0;
  for (double t = -length; t < length; t += 1e-4 * length)
    energy += 1e-4 * length * std::norm(echo_envelope(burst, {}, 0).at(t));
  EXPECT_NEAR(energy_length(burst, c0), c0 / 2 * energy, 1e-6 * energy_length(burst, c0));
  for (const double tolerance : {0.5, 0.01, 1e-4})
    EXPECT_NEAR(std::abs(echo_envelope(burst, {}, 0).at(pulse_half_length(burst, tolerance))), tolerance, 1e-12);
}

// sin(x) / x is -1 dB at x = 0.8215, a quarter of the bandwidth, and 0 at the bandwidth.
TEST(ToneBurst, loses_a_decibel_at_a_quarter_of_its_bandwidth) {
  const EchoShapes shapes(burst, {c0, {}});
  EXPECT_EQ(doppler_delay(burst, 900), 0);
  for (const double x : {0.8215, 2.0, pi})
    EXPECT_NEAR(std::abs(shapes.of(0, x / pi * burst.bandwidth).at(0)), std::sin(x) / x, 1e-9);
  EXPECT_NEAR(db_from_amplitude(std::abs(shapes.of(0, 0.8215 / pi * burst.bandwidth).at(0))), -1, 1e-3);
}

// The energy that is left of sinc^4, frequency by frequency, where absorption takes more than 20 dB.
TEST(ToneBurst, keeps_the_energy_that_absorption_leaves) {
  const double range = 500;
  const Absorption a = absorption_about({}, burst.centre_frequency, 2);
  double kept = 0, sent = 0;
  for (double x = -6; x < 6; x += 1e-3) {
    const double y = pi * (x + 1e-9), power = std::pow(std::sin(y) / y, 4), f = x * burst.bandwidth;
    sent += power, kept += power * std::exp(-4 * range * (a.a0 + f * (a.a1 + f * a.a2)));
  }
  const EchoEnvelope echo = echo_envelope(burst, a, range);
  EXPECT_LT(db_from_power(kept / sent), -20);
  EXPECT_NEAR(db_from_power(std::norm(echo.at(0))), db_from_power(kept / sent), 0.02);
}

TEST(HyperbolicFm, echo_is_the_correlation_with_the_replica) {
  for (const ReplicaWindow window : {ReplicaWindow::uniform, ReplicaWindow::hamming})
    for (const double product : {30.0, 150.0})
      for (const double doppler : {0.0, 600.0, -1200.0}) {
        const Pulse pulse = hunter(product, window);
        const EchoEnvelope echo = EchoShapes(pulse, {c0, {}}).of(0, doppler);
        double worst = 0;
        for (int n = -40; n <= 40; ++n)
          for (const double t : {n * pulse.duration / 41.3, 0.11 * n / pulse.bandwidth})
            worst = std::max(worst, std::abs(echo.at(t) - hyperbolic_echo(pulse, t, doppler)));
        EXPECT_LT(worst, 0.02 / product) << "BT " << product << ", doppler " << doppler;
      }
}

// The ambiguity of the sweep on the line of stretched signals: approaching at 5 m/s it comes early by (p_0 / q) (1 - 1 /
// eta), and loses what no longer overlaps. A linear sweep of the same band, stretched, loses its peak.
TEST(HyperbolicFm, tolerates_five_metres_per_second) {
  for (const ReplicaWindow window : {ReplicaWindow::uniform, ReplicaWindow::hamming})
    for (const double speed : {5.0, -5.0, 2.0}) {
      const Pulse pulse = hunter(600, window);
      const double doppler = pulse.centre_frequency * 2 * speed / (c0 - speed),
                   eta = 1 + doppler / pulse.centre_frequency;
      const EchoEnvelope echo = EchoShapes(pulse, {c0, {}}).of(0, doppler);
      const auto [peak, time] = peak_of(echo, -0.05 * pulse.duration, 0.05 * pulse.duration, pulse.bandwidth);
      if (window == ReplicaWindow::hamming) {
        EXPECT_GT(db_from_amplitude(peak), -0.1) << speed;
      } else {  // what is left of the overlap of a sweep of length T / eta with the replica
        const double later = std::abs(doppler_delay(pulse, doppler)) / pulse.duration;
        const double left = std::min({1.0, 1 / eta, 0.5 + 0.5 / eta - later});
        EXPECT_NEAR(db_from_amplitude(peak), db_from_amplitude(left), 0.003) << speed;
      }
      const double p1 = 1 / 60e3, p2 = 1 / 120e3;
      const double bias = 0.5 * (p1 + p2) / ((p2 - p1) / pulse.duration) * (1 - 1 / eta);
      EXPECT_NEAR(time, bias, 0.02 / pulse.bandwidth) << speed;
      EXPECT_NEAR(doppler_delay(pulse, doppler), bias, 1e-12);
    }
}

TEST(HyperbolicFm, half_length_bounds_the_echo) {
  for (const ReplicaWindow window : {ReplicaWindow::uniform, ReplicaWindow::hann, ReplicaWindow::hamming})
    for (const double product : {3.0, 40.0, 600.0})
      for (const double tolerance : {0.1, 0.01, 1e-3}) {
        const Pulse pulse = hunter(product, window);
        const EchoEnvelope echo = echo_envelope(pulse, {}, 0);
        for (double t = pulse_half_length(pulse, tolerance); t < pulse.duration; t += 0.03 / pulse.bandwidth)
          ASSERT_LE(std::abs(echo.at(t)), tolerance + 0.02 / product) << product << ", " << tolerance << ", t " << t;
      }
}

// Mean and deviation of the frequencies, and the energy, against the transform of the echo.
TEST(HyperbolicFm, spectrum_has_its_moments) {
  const Pulse pulse = hunter(300, ReplicaWindow::hamming);
  const EchoEnvelope echo = echo_envelope(pulse, {}, 0);
  double sum = 0, mean = 0, square = 0;
  for (double f = -0.7 * pulse.bandwidth; f < 0.7 * pulse.bandwidth; f += 100) {
    Complex at = 0;
    for (double t = -pulse.duration; t < pulse.duration; t += 0.25 / pulse.bandwidth)
      at += echo.at(t) * std::polar(1.0, 2 * pi * f * t);
    sum += std::norm(at), mean += f * std::norm(at), square += f * f * std::norm(at);
  }
  mean /= sum;
  const SpectrumMoments moments = kind_of(pulse).moments(pulse);
  EXPECT_NEAR(moments.mean, mean, 0.01 * pulse.bandwidth);
  EXPECT_NEAR(moments.deviation, std::sqrt(square / sum - mean * mean), 0.01 * pulse.bandwidth);
}

// Each frequency of the sum is absorbed by itself: the energy of the echo against that of its filtered spectrum.
TEST(HyperbolicFm, each_frequency_has_its_absorption) {
  const Pulse pulse = hunter(200, ReplicaWindow::hamming);
  const double range = 120;
  const Absorption a = absorption_about({}, pulse.centre_frequency, 2);
  const EchoEnvelope flat = echo_envelope(pulse, {}, 0), lossy = echo_envelope(pulse, a, range);
  double kept = 0, found = 0;
  const double step = 0.25 / pulse.bandwidth;
  for (double f = -2 * pulse.bandwidth; f < 2 * pulse.bandwidth; f += 0.2 / pulse.duration) {
    Complex at = 0;
    for (double t = -pulse.duration; t < pulse.duration; t += step)
      at += step * flat.at(t) * std::polar(1.0, 2 * pi * f * t);
    const double within = std::clamp(f, -0.5 * pulse.bandwidth, 0.5 * pulse.bandwidth);
    kept += 0.2 / pulse.duration * std::norm(at) * std::exp(-4 * range * (a.a0 + within * (a.a1 + within * a.a2)));
  }
  for (double t = -pulse.duration; t < pulse.duration; t += step) found += step * std::norm(lossy.at(t));
  EXPECT_NEAR(db_from_power(found / kept), 0, 0.01);
  EXPECT_LT(db_from_power(found), db_from_power(energy_length(pulse, 2)) - 5);  // the sea takes more than 5 dB
}

TEST(HyperbolicFm, is_refused_as_sweeps_are) {
  Pulse pulse = hunter(100, ReplicaWindow::hann);
  const auto refusal = [&] { return error_of([&] { require_valid(pulse, "test"); }); };
  EXPECT_EQ(refusal(), "no error");
  pulse.duration = 1;
  EXPECT_EQ(refusal(),
            "test: duration = 1 s times bandwidth = 60000 Hz is 60000, must be within 1 and 2e4 for a sweep");
  pulse.duration = 1e-6;
  EXPECT_THAT(refusal(), testing::HasSubstr("must be within 1 and 2e4"));
}

}  // namespace insonify::matched_pulses_tests
