// SPDX-License-Identifier: BSD-3-Clause
// First-order laws of speckle: statistics of single pixels over independent cells and seeds. Seeds are fixed, so
// results are reproducible; tolerances are multiples of the standard error stated beside them.
#include "acoustics/direct_echoes.hpp"
#include "simulate/simulate_ping.hpp"
#include "speckle_bench.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

using namespace insonify::laws;

namespace {

/// Returns beams one null width apart and bins four pulse lengths apart, which receive different parts of the bottom.
SonarHead bottom_head() {
  std::vector<double> azimuths;
  for (int b = -3; b <= 3; ++b) azimuths.push_back(std::asin(b * 2.0 / 101));
  const double bandwidth = 20e3, bin = 0.44 * speed / (2 * bandwidth);
  return head_with(one_degree_array(), azimuths, bandwidth, {7.2, 8.9, bin});
}
constexpr Eigen::Index bins_between = 4;

/// Returns the mean intensity of one pixel in closed form: the sum of the patches' powers, each with beam and pulse.
double mean_intensity(const Echoes& coherent, const SonarHead& head, std::size_t beam, std::size_t bin) {
  const EchoEnvelope envelope = echo_envelope(head.pulse, {}, 1);
  const double u_beam = std::sin(head.fan.azimuth[beam]), now = 2 * head.gate.centre(bin) / speed;
  double sum = 0;
  for (std::size_t i = 0; i < coherent.size(); ++i) {
    const double t = now - coherent.delay[i];
    if (std::abs(t) > pulse_half_length(head.pulse, 1e-6)) continue;
    const double b = array_response(head.array, wavelength, coherent.u[i], u_beam).real();
    sum += std::norm(coherent.amplitude[i] * envelope.at(t)) * b * b;
  }
  return sum;
}

/// Returns intensities of independent pixels over their own mean: `seeds` looks at a flat Lambert bottom.
const std::vector<double>& bottom_intensities() {
  static const std::vector<double> intensities = [] {
    const SceneCloud scene = flat_bottom();
    const SonarHead head = bottom_head();
    const Scatterers s = visible(scene, head, Pose::Identity());
    EchoOptions options;
    options.amplitude = SurfaceAmplitude::coherent;
    const Echoes steady = direct_echoes(s, scene.materials, head.pulse, clear_water(), options);
    const auto beams = static_cast<Eigen::Index>(head.fan.beams()), bins = static_cast<Eigen::Index>(head.gate.bins());
    Grid<double> mean(beams, bins);
    for (Eigen::Index b = 0; b < beams; ++b)
      for (Eigen::Index n = 0; n < bins; n += bins_between)
        mean(b, n) = mean_intensity(steady, head, static_cast<std::size_t>(b), static_cast<std::size_t>(n));
    std::vector<double> result;
    options.amplitude = SurfaceAmplitude::complex_normal;
    for (options.seed = 1; options.seed <= 45; ++options.seed) {
      const ComplexGrid p = synthesize_gridded(direct_echoes(s, scene.materials, head.pulse, clear_water(), options),
                                               head, clear_water());
      for (Eigen::Index b = 0; b < beams; ++b)
        for (Eigen::Index n = 0; n < bins; n += bins_between) result.push_back(std::norm(p(b, n)) / mean(b, n));
    }
    return result;
  }();
  return intensities;
}

/// Returns the largest distance between the sample's distribution and 1 - exp(-x), that of squared Rayleigh amplitudes.
double distance_from_exponential(std::vector<double> sample) {
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<double>(sample.size());
  double distance = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double expected = -std::expm1(-sample[i]), rank = static_cast<double>(i);
    distance = std::max({distance, expected - rank / n, (rank + 1) / n - expected});
  }
  return distance;
}

Moments moments_of(const std::vector<double>& intensities) {
  Moments m;
  for (const double i : intensities) m.add(std::sqrt(i));
  return m;
}

std::vector<int> poisson_numbers(double mean, std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<int> numbers(count);
  for (int& n : numbers) {  // Knuth's product of uniforms: std::poisson_distribution is not the same everywhere
    double product = 1;
    for (n = -1; product > std::exp(-mean); ++n) product *= static_cast<double>(random() >> 11) * 0x1p-53;
  }
  return numbers;
}

}  // namespace

// The test of Kolmogorov and Smirnov refuses a true law in 5 of 100 cases beyond 1.358 / sqrt(n), and a law whose
// distribution is off by 3 % anywhere almost surely at this n.
TEST(SpeckleLaws, a_flat_lambert_bottom_has_rayleigh_amplitudes_and_exponential_intensities) {
  const auto& sample = bottom_intensities();
  const auto n = static_cast<double>(sample.size());
  ASSERT_GT(n, 8000);
  EXPECT_LT(distance_from_exponential(sample), 1.358 / std::sqrt(n));
  std::vector<double> louder = sample;
  for (double& i : louder) i *= 1.1;  // 0.4 dB too loud: the test detects it
  EXPECT_GT(distance_from_exponential(louder), 1.95 / std::sqrt(n));
}

// Standard errors over n pixels: amplitude sqrt(1 - pi / 4) = 0.463, intensity 1, level 5.570 dB, each over sqrt(n);
// contrast 1 / sqrt(n); standard deviation of the level 5.570 dB x 1.05 / sqrt(n) (its kurtosis is 5.4). Three of each.
TEST(SpeckleLaws, moments_of_a_flat_lambert_bottom_are_those_of_fully_developed_speckle) {
  const Moments m = moments_of(bottom_intensities());
  const double error = 3 / std::sqrt(m.n);
  EXPECT_NEAR(m.intensity / m.n, 1, error);
  EXPECT_NEAR(m.amplitude / m.n, std::sqrt(pi) / 2, 0.463 * error);  // mean / rms = 0.886227
  EXPECT_NEAR(std::sqrt(m.square_ratio() - 1), 1, error);
  const double mean_db = m.level_db / m.n, sd_db = std::sqrt(m.level_square / m.n - mean_db * mean_db);
  EXPECT_NEAR(mean_db, -10 * std::numbers::egamma / std::numbers::ln10, 5.57 * error);  // -2.507 dB
  EXPECT_NEAR(sd_db, 10 / std::numbers::ln10 * pi / std::sqrt(6.0), 5.85 * error);      // 5.570 dB
}

TEST(SpeckleLaws, fixed_numbers_of_equal_patches_with_random_phases_have_2_less_1_over_n) {
  for (const int n : {1, 2, 5, 20}) {
    Moments m;
    EchoOptions options;
    options.amplitude = SurfaceAmplitude::random_phase;
    const Groups groups = make_groups(std::vector<int>(5000, n));
    for (options.seed = 1; options.seed <= 4; ++options.seed)
      for (const Complex p : pressure_of_groups(groups, options)) m.add(p);
    // The square's standard deviation is at most sqrt(20), that of the exponential law: 20 000 groups, three errors.
    EXPECT_NEAR(m.intensity / m.n, n, 3 * n / std::sqrt(m.n));
    EXPECT_NEAR(m.square_ratio(), 2 - 1.0 / n, n == 1 ? 1e-3 : 0.1) << n << " patches";
  }
}

TEST(SpeckleLaws, complex_normal_amplitudes_are_rayleigh_even_from_a_single_patch) {
  std::vector<double> sample;
  EchoOptions options;
  const Groups groups = make_groups(std::vector<int>(5000, 1));
  for (const Complex p : pressure_of_groups(groups, options)) sample.push_back(std::norm(p));
  EXPECT_LT(distance_from_exponential(sample), 1.358 / std::sqrt(static_cast<double>(sample.size())));
}

// Given the number N the intensity is exponential about N patches' power, so <I^2> = 2 <N^2>: with Poisson numbers
// <I^2> / <I>^2 = 2 (1 + 1 / <N>), as of a K distribution. Its error follows from <I^4> = 24 <N^4> and, with the
// mean m,
// <N^4> = m + 7 m^2 + 6 m^3 + m^4.
TEST(SpeckleLaws, poisson_numbers_of_patches_have_2_times_1_plus_1_over_their_mean) {
  for (const double mean : {0.5, 1.0, 5.0, 20.0}) {
    Moments m;
    for (unsigned look = 0; look < 5; ++look) {
      const Groups groups = make_groups(poisson_numbers(mean, 8000, 40 + look));
      for (const Complex p : pressure_of_groups(groups, {.seed = 1 + look})) m.add(p);
    }
    const double fourth = 24 * (mean + 7 * std::pow(mean, 2) + 6 * std::pow(mean, 3) + std::pow(mean, 4));
    const double square = 2 * (mean + mean * mean), error = std::sqrt((fourth - square * square) / m.n) / square;
    EXPECT_NEAR(m.square_ratio() / (2 * (1 + 1 / mean)), 1, 3 * error) << mean << " patches on average";
    EXPECT_LT(3 * error, 0.1);
  }
}

// sqrt(g) + sqrt(1 - g) z has the mean field sqrt(g), the mean power 1, and <I^2> = 2 - g^2 = 1 + (1 + 2 K) / (1 + K)^2
// with the K factor g / (1 - g). Errors over 20 000 patches: field sqrt((1 - g) / n), power sqrt((1 - g^2) / n), square
// at most sqrt(20 / n).
TEST(SpeckleLaws, rician_fraction_sets_mean_field_and_square_at_constant_power) {
  for (const double g : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    Moments m;
    EchoOptions options;
    const Groups groups = make_groups(std::vector<int>(5000, 1));
    for (options.seed = 1; options.seed <= 4; ++options.seed)
      for (const Complex p : pressure_of_groups(groups, options, g)) m.add(p);
    EXPECT_LT(std::abs(m.field / m.n - std::sqrt(g)), 3 * std::sqrt((1 - g) / m.n) + 1e-3) << g;
    EXPECT_NEAR(m.intensity / m.n, 1, 3 * std::sqrt((1 - g * g) / m.n) + 1e-3) << g;
    EXPECT_NEAR(m.square / m.n, 2 - g * g, 3 * std::sqrt(20 * (1 - g * g) / m.n) + 1e-3) << g;
    if (g == 1) continue;
    const double k = g / (1 - g);
    EXPECT_NEAR(m.square_ratio(), 1 + (1 + 2 * k) / std::pow(1 + k, 2), 3 * std::sqrt(20 / m.n)) << g;
  }
}
