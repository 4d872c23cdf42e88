// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/synthesize_noise.hpp"

#include "beamforming/synthesize.hpp"
#include "sonar/shading.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

constexpr double level = 60;

SonarHead noise_head(std::size_t elements, std::size_t beams = 5) {
  SonarHead head;
  head.pulse = {750e3, 60e3, 220};
  head.fan = make_fan(beams, radians(8), radians(4), radians(20));
  head.gate = {1, 12, default_bin_size(head.pulse, c0)};
  head.array = {0.5 * c0 / 750e3, uniform_shading(elements)};
  return head;
}

ComplexGrid noise(const SonarHead& head, const NoiseOptions& options = {}) {
  return synthesize_noise(head, {c0, {}}, level, options);
}

double mean_power(const ComplexGrid& p) { return p.abs2().mean(); }

std::complex<double> correlation(const auto& a, const auto& b) {
  return (a * b.conjugate()).sum() / std::sqrt(a.abs2().sum() * b.abs2().sum());
}

}  // namespace

// 32 elements: 10 log 32 = 15.05 dB below one element. 2000 bins of 5 correlated beams: 0.15 dB of scatter.
TEST(SynthesizeNoise, of_a_beam_is_the_element_level_less_its_directivity) {
  const double one = pressure_level_db(std::sqrt(mean_power(noise(noise_head(1)))));
  EXPECT_NEAR(one, level, 0.4);
  const double beam = pressure_level_db(std::sqrt(mean_power(noise(noise_head(32)))));
  EXPECT_NEAR(beam, level - 10 * std::log10(32), 0.4);
}

TEST(SynthesizeNoise, is_exponential_in_intensity) {
  const ComplexGrid p = noise(noise_head(16));
  EXPECT_NEAR(p.abs2().square().mean() / std::pow(mean_power(p), 2), 2, 0.2);
}

// Independent elements: two beams share noise as far as their patterns overlap, B(u_b - u_b') for uniform shading.
TEST(SynthesizeNoise, of_overlapping_beams_is_correlated_by_the_array_response) {
  const SonarHead head = noise_head(32);
  const ComplexGrid p = noise(head);
  for (int b = 1; b < 5; ++b) {
    const double expected = array_response(head.array, c0 / 750e3, std::sin(head.fan.azimuth[0]),
                                           std::sin(head.fan.azimuth[static_cast<std::size_t>(b)]))
                                .real();
    EXPECT_NEAR(std::abs(correlation(p.row(0), p.row(b)) - expected), 0, 0.08) << "beam " << b;
  }
}

// Filtered white noise has the autocorrelation of the filter, here the pulse's envelope on the bins. 18 000 bins
// scatter by 0.01.
TEST(SynthesizeNoise, has_the_band_of_the_pulse) {
  SonarHead head = noise_head(8, 1);
  head.gate.max_range = 100;
  const ComplexGrid p = noise(head);
  const auto e = [&](int k) { return echo_envelope(head.pulse, {}, 0).at(k * 2 * head.gate.bin_size / c0).real(); };
  for (int lag = 1; lag <= 3; ++lag) {
    double expected = 0, energy = 0;
    for (int k = -20; k <= 20; ++k) expected += e(k) * e(k + lag), energy += e(k) * e(k);
    const auto n = p.cols() - lag;
    const auto measured = correlation(p.row(0).head(n), p.row(0).tail(n));
    EXPECT_NEAR(std::abs(measured - expected / energy), 0, 0.04) << "lag " << lag;
  }
}

TEST(SynthesizeNoise, depends_on_ping_and_seed_but_not_on_threads) {
  const SonarHead head = noise_head(16);
  const ComplexGrid p = noise(head, {.seed = 1, .ping = 3, .threads = 1});
  for (const int threads : {2, 7}) EXPECT_TRUE((noise(head, {.seed = 1, .ping = 3, .threads = threads}) == p).all());
  EXPECT_LT(std::abs(correlation(noise(head, {.seed = 1, .ping = 4}), p)), 0.05);
  EXPECT_LT(std::abs(correlation(noise(head, {.seed = 2, .ping = 3}), p)), 0.05);
}

TEST(SynthesizeNoise, refuses_a_level_that_is_not_finite) {
  EXPECT_THROW(synthesize_noise(noise_head(4), {c0, {}}, std::nan("")), Error);
}
