// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/noise.hpp"
#include "sonar/pulse.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

using Complex = std::complex<double>;

namespace {

const std::vector<ReplicaWindow> windows = {ReplicaWindow::uniform, ReplicaWindow::hann, ReplicaWindow::hamming};

Pulse sweep(double time_bandwidth, ReplicaWindow window, double bandwidth = 40e3) {
  return {400e3, bandwidth, 220, PulseShape::linear_fm, time_bandwidth / bandwidth, window};
}

/// Returns the matched filter by quadrature: the echo `received(tau)`, |tau| < T/2, times the weighted replica moved to
/// `t`, per area of the weights. Gauss and Legendre, five points per quarter of a cycle.
template <typename Received>
Complex correlation(const Pulse& pulse, Received received, double t) {
  const double half = 0.5 * pulse.duration, rate = pulse.bandwidth / pulse.duration;
  const double level = pulse.window == ReplicaWindow::uniform ? 1 : pulse.window == ReplicaWindow::hann ? 0.5 : 0.54;
  const double low = std::max(-half, t - half), high = std::min(half, t + half);
  if (high <= low) return 0;
  const double x[] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831, 0.9061798459386640};
  const double w[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                      0.2369268850561891};
  const int panels = 300 + static_cast<int>(4 * pulse.bandwidth * pulse.duration);
  const double width = (high - low) / panels;
  Complex sum = 0;
  for (int p = 0; p < panels; ++p)
    for (int g = 0; g < 5; ++g) {
      const double tau = low + (p + 0.5 + 0.5 * x[g]) * width, moved = tau - t;
      const double weight = level + (1 - level) * std::cos(2 * pi * moved / pulse.duration);
      sum += 0.5 * w[g] * width * weight * received(tau) * std::polar(1.0, pi * rate * moved * moved);
    }
  return sum / (level * pulse.duration);
}

/// Returns times all over the pulse, and close to its peak.
std::vector<double> some_times(const Pulse& pulse) {
  std::vector<double> times;
  for (int n = -30; n <= 30; ++n) {
    times.push_back(pulse.duration * n / 30.3);
    times.push_back(0.15 * n / pulse.bandwidth);
  }
  return times;
}

double level_db(const EchoEnvelope& e, double t) { return db_from_amplitude(std::abs(e.at(t))); }

/// Returns the highest level beyond `from` [dB re peak].
double highest_beyond(const Pulse& pulse, double from, double to) {
  const EchoEnvelope e = echo_envelope(pulse, {}, 0);
  double highest = -400;
  for (double t = from; t < to; t += 0.01 / pulse.bandwidth) highest = std::max(highest, level_db(e, t));
  return highest;
}

std::string refusal(const Pulse& pulse) {
  return error_of([&] { require_valid(pulse, "test"); });
}

}  // namespace

TEST(LinearFm, closed_form_is_the_correlation_with_the_replica) {
  for (const ReplicaWindow window : windows)
    for (const double product : {1.0, 7.3, 100.0, 1000.0}) {
      const Pulse pulse = sweep(product, window);
      const double rate = pulse.bandwidth / pulse.duration;
      const EchoEnvelope e = echo_envelope(pulse, {}, 0);
      for (const double t : some_times(pulse)) {
        const auto sent = [&](double tau) { return std::polar(1.0, -pi * rate * tau * tau); };
        EXPECT_LT(std::abs(e.at(t) - correlation(pulse, sent, t)), 1e-11) << "BT " << product << ", t " << t;
      }
    }
}

// Unit peak whatever the window; nothing outside the sweep's length.
TEST(LinearFm, peaks_at_one_and_ends_with_the_sweep) {
  for (const ReplicaWindow window : windows) {
    const Pulse pulse = sweep(120, window);
    const EchoEnvelope e = echo_envelope(pulse, {0.02, 0, 0}, 25);
    EXPECT_NEAR(std::abs(e.at(0) - std::exp(-1.0)), 0, 1e-15);
    for (const double t : {1.0, -1.0, 1.5, -100.0}) EXPECT_EQ(std::abs(e.at(t * pulse.duration)), 0);
    EXPECT_LE(pulse_half_length(pulse, 1e-9), pulse.duration);
  }
}

// Side lobes of a long sweep are those of the window's transform: -13.26 dB uniform, -31.5 dB Hann, -42.7 dB Hamming
// (Harris 1978). The first 30 of them, before the sweep's unweighted end shows.
TEST(LinearFm, side_lobes_are_those_of_the_window) {
  EXPECT_NEAR(highest_beyond(sweep(5000, ReplicaWindow::uniform), 1.0 / 40e3, 30 / 40e3), -13.26, 0.05);
  EXPECT_NEAR(highest_beyond(sweep(5000, ReplicaWindow::hann), 2.0 / 40e3, 30 / 40e3), -31.47, 0.05);
  EXPECT_NEAR(highest_beyond(sweep(5000, ReplicaWindow::hamming), 2.0 / 40e3, 30 / 40e3), -42.68, 0.1);
}

// sinc^2(x) = 1/2 at x = 0.44295: 0.8859 / B. Hann 1.4406 and Hamming 1.3031: -3 dB widths 1.44 and 1.30 bins of the
// windows (Harris 1978).
TEST(LinearFm, width_at_half_intensity_is_that_of_the_window) {
  const double expected[] = {0.8859, 1.4406, 1.3031};
  for (std::size_t w = 0; w < windows.size(); ++w) {
    EXPECT_NEAR(range_resolution(sweep(5000, windows[w]), c0) / (c0 / 2 / 40e3), expected[w], 3e-4);
    EXPECT_NEAR(range_resolution(sweep(100, windows[w]), c0) / (c0 / 2 / 40e3), expected[w], 0.01 * expected[w]);
    const Pulse pulse = sweep(100, windows[w]);
    EXPECT_NEAR(std::norm(echo_envelope(pulse, {}, 0).at(range_resolution(pulse, c0) / c0)), 0.5, 1e-9);
  }
  EXPECT_DOUBLE_EQ(nominal_range_resolution(sweep(100, windows[0]), c0), c0 / 80e3);
  EXPECT_DOUBLE_EQ(nominal_range_resolution({900e3, 29.5e3, 220}, c0), c0 / 59e3);
}

TEST(LinearFm, half_length_bounds_the_envelope) {
  for (const ReplicaWindow window : windows)
    for (const double product : {1.0, 3.0, 30.0, 1000.0}) {
      const Pulse pulse = sweep(product, window);
      const EchoEnvelope e = echo_envelope(pulse, {}, 0);
      for (const double tolerance : {0.5, 0.1, 0.01, 1e-3, 1e-5}) {
        const double half = pulse_half_length(pulse, tolerance);
        EXPECT_LE(half, pulse.duration);
        for (double t = half; t < pulse.duration; t += 0.03 / pulse.bandwidth)
          ASSERT_LE(std::abs(e.at(t)), tolerance) << "BT " << product << ", tolerance " << tolerance << ", t " << t;
      }
    }
}

// The sweep after propagation, as defined in pulse.hpp, correlated by quadrature.
TEST(LinearFm, closed_form_with_frequency_dependent_absorption_is_the_correlation) {
  const double range = 90;
  const Complex i{0, 1};
  for (const ReplicaWindow window : windows)
    for (const Absorption a :
         {Absorption{0.02, 8e-8, 0}, {0.02, 8e-8, 1e-13}, {0.02, -8e-8, -2e-12}, {0.2, 1e-6, 2e-11}})
      for (const double doppler : {0.0, 700.0, -90.0}) {
        const Pulse pulse = sweep(80, window);
        const double k = pulse.bandwidth / pulse.duration, b = 2 * a.a1 * range;
        const Complex k2 = k / (1.0 + 2.0 * i * a.a2 * range * k / pi);
        const auto received = [&](double t) {
          return std::sqrt(k2 / k) * std::exp(-2 * a.a0 * range + i * k2 * b * b / (4 * pi) - k2 * b * t -
                                              i * pi * k2 * t * t - 2.0 * pi * i * doppler * t);
        };
        const EchoEnvelope e = EchoShapes(pulse, {c0, a}).of(2 * range / c0, doppler);
        double worst = 0, peak = 0;
        for (const double t : some_times(pulse)) {
          worst = std::max(worst, std::abs(e.at(t) - correlation(pulse, received, t)));
          peak = std::max(peak, std::abs(e.at(t)));
        }
        EXPECT_LT(worst, 1e-11 * peak) << "a1 " << a.a1 << ", a2 " << a.a2 << ", doppler " << doppler;
      }
}

TEST(LinearFm, small_slopes_of_absorption_approach_constant_absorption) {
  const Pulse pulse = sweep(60, ReplicaWindow::hamming);
  const EchoEnvelope flat = echo_envelope(pulse, {0.01, 0, 0}, 50);
  for (const Absorption a : {Absorption{0.01, 1e-18, 0}, {0.01, 0, 1e-24}, {0.01, 0, -1e-24}})
    for (const double t : some_times(pulse))
      EXPECT_LT(std::abs(echo_envelope(pulse, a, 50).at(t) - flat.at(t)), 1e-11) << a.a1 << ", " << a.a2;
}

// At any range no overflow and no NaN: an echo decays.
TEST(LinearFm, decays_with_range_without_overflow) {
  const Pulse pulse = sweep(60, ReplicaWindow::hann);
  const Absorption a{0.03, 1.5e-7, 1.9e-13};
  double before = 1;
  for (const double range : {1.0, 10.0, 100.0, 1e3, 2e3, 1e4, 1e6, 1e9}) {
    const EchoEnvelope e = echo_envelope(pulse, a, range);
    double peak = 0;
    for (const double t : some_times(pulse)) peak = std::max(peak, std::abs(e.at(t)));
    EXPECT_TRUE(std::isfinite(peak)) << range;
    EXPECT_LE(peak, before) << range;
    before = peak;
  }
  EXPECT_EQ(before, 0);
}

TEST(LinearFm, refuses_absorption_that_makes_it_grow) {
  const Pulse pulse = sweep(60, ReplicaWindow::hann);
  for (const Absorption a : {Absorption{0.01, 1e-6, 0}, {0.01, -1e-6, 0}, {0.01, 0, -1e-10}})
    EXPECT_THROW(echo_envelope(pulse, a, 50), Error);
}

// Range-Doppler coupling of a rising sweep: an approaching target, shifted up by f_d, appears f_d / k early; its peak
// falls with the overlap that is left. Exact for the uniform window: (1 - |t|/T) at t = -f_d / k.
TEST(LinearFm, doppler_moves_the_peak) {
  const Pulse pulse = sweep(200, ReplicaWindow::uniform);
  const double k = pulse.bandwidth / pulse.duration;
  for (const double doppler : {400.0, -2500.0}) {
    const EchoEnvelope e = EchoShapes(pulse, {c0, {}}).of(0.1, doppler);
    double best = 0, peak = 0;
    for (double t = -0.2 * pulse.duration; t < 0.2 * pulse.duration; t += 0.001 / pulse.bandwidth)
      if (std::abs(e.at(t)) > peak) peak = std::abs(e.at(t)), best = t;
    EXPECT_NEAR(best, -doppler / k, 0.01 / pulse.bandwidth);
    EXPECT_NEAR(std::abs(e.at(-doppler / k)), 1 - std::abs(doppler / k) / pulse.duration, 1e-12);
  }
}

// A burst turns as exp(-2 pi i f_d t): its spectrum, with the time factor exp(-i omega t), stands f_d higher.
TEST(LinearFm, doppler_of_a_gaussian_moves_its_spectrum) {
  const Pulse pulse{900e3, 29.5e3, 220};
  const Absorption a{0.02, 1e-7, 1e-13};
  const EchoEnvelope still = echo_envelope(pulse, a, 75), moving = EchoShapes(pulse, {c0, a}).of(0.1, 1300);
  const auto spectrum = [](const EchoEnvelope& e, double f) {
    Complex sum = 0;
    for (double t = -1e-4; t <= 1e-4; t += 1e-7) sum += e.at(t) * std::polar(1.0, 2 * pi * f * t);
    return sum;
  };
  for (const double f : {-20e3, 0.0, 15e3})
    EXPECT_LT(std::abs(spectrum(moving, f + 1300) - spectrum(still, f)), 1e-9 * std::abs(spectrum(still, 0)));
}

// The Gaussian's numbers are those of its own formulas, to the last bit, for every code path.
TEST(EchoShapes, leave_a_gaussian_unchanged) {
  const Pulse pulse{900e3, 29.5e3, 220};
  const double delay = 0.0837;
  for (const Absorption a : {Absorption{0.02, 0, 0}, {0.02, 1e-7, 0}, {0.02, 1e-7, 1e-13}}) {
    const double range = 0.5 * c0 * delay;
    const EchoEnvelope plain = echo_envelope(pulse, a, range), shape = EchoShapes(pulse, {c0, a}).of(delay);
    const double sent = 2 * std::numbers::ln2 / (pulse.bandwidth * pulse.bandwidth);
    EXPECT_EQ(plain.a, sent + 2 * a.a2 * range);
    EXPECT_EQ(plain.gain, std::sqrt(sent / plain.a) * std::exp(plain.b * plain.b / (4 * plain.a) - 2 * a.a0 * range));
    for (const double t : {-3e-5, 0.0, 1e-6, 2e-5}) {
      const double w = 2 * pi * t, magnitude = plain.gain * std::exp(-w * w / (4 * plain.a));
      EXPECT_EQ(plain.at(t), a.a1 == 0 ? Complex(magnitude) : std::polar(magnitude, plain.b * w / (2 * plain.a)));
      EXPECT_EQ(shape.at(t), plain.at(t));
    }
  }
}

// White noise behind the filter h = conj(w s) / integral w: integral abs(h)^2. Hann 1.5, Hamming 1.3628 (Harris 1978).
TEST(NoiseBandwidth, of_a_matched_filter_is_about_one_over_its_length) {
  const double expected[] = {1, 1.5, 1.3628};
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const Pulse pulse = sweep(100, windows[w]);
    double energy = 0, area = 0;
    for (int n = 0; n < 10000; ++n) {
      const double weight = replica_weight(pulse, ((n + 0.5) / 10000 - 0.5) * pulse.duration);
      energy += weight * weight, area += weight;
    }
    EXPECT_NEAR(noise_bandwidth(pulse), energy / (area * area) * 10000 / pulse.duration, 1e-9 / pulse.duration);
    EXPECT_NEAR(noise_bandwidth(pulse) * pulse.duration, expected[w], 1e-4);
  }
  // A Gaussian of full -3 dB power width B, by quadrature of its power response.
  double area = 0;
  for (double f = -4; f < 4; f += 1e-3) area += 1e-3 * std::exp2(-4 * f * f);
  EXPECT_NEAR(noise_bandwidth({900e3, 29.5e3, 220}), area * 29.5e3, 1e-9 * 29.5e3);
}

// Processing gain: a uniform sweep has a noise power lower by 1.0645 BT than a Gaussian burst of the same bandwidth.
TEST(NoiseBandwidth, lowers_the_noise_by_the_time_bandwidth_product) {
  const Pulse burst{400e3, 40e3, 220}, pulse = sweep(100, ReplicaWindow::uniform);
  EXPECT_NEAR(thermal_noise_level_db(burst) - thermal_noise_level_db(pulse), 20.27132, 1e-5);
  EXPECT_NEAR(ambient_noise_level_db(burst, 5) - ambient_noise_level_db(pulse, 5), 20.27132, 1e-5);
}

TEST(LinearFm, refuses_invalid_sweeps) {
  Pulse pulse = sweep(100, ReplicaWindow::hann);
  EXPECT_EQ(refusal(pulse), "no error");
  pulse.duration = 0;
  EXPECT_EQ(refusal(pulse), "test: duration = 0 s, must be finite and > 0 for a sweep");
  pulse.duration = std::nan("");
  EXPECT_EQ(refusal(pulse), "test: duration = nan s, must be finite and > 0 for a sweep");
  pulse.duration = 1e-5;
  EXPECT_EQ(refusal(pulse),
            "test: duration = 1e-05 s times bandwidth = 40000 Hz is 0.4, must be within 1 and 1e6 for a sweep");
  pulse.duration = 100;
  EXPECT_EQ(refusal(pulse),
            "test: duration = 100 s times bandwidth = 40000 Hz is 4000000, must be within 1 and 1e6 for a sweep");
  pulse.shape = PulseShape::gaussian;  // which has no duration of its own
  EXPECT_EQ(refusal(pulse), "no error");
}
