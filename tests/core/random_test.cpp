// SPDX-License-Identifier: BSD-3-Clause
#include "core/random.hpp"

#include "support/test.hpp"

// Known answer of Philox4x64-10 from the Random123 distribution (kat_vectors): key 0, counter 0.
TEST(Random, is_philox_4x64_10) {
  const auto bits = random_bits(0, RandomStage{0}, {});
  EXPECT_EQ(bits[0], 0x16554d9eca36314cULL);
  EXPECT_EQ(bits[1], 0xdb20fe9d672d0fdcULL);
}

TEST(Random, depends_on_seed_stage_and_every_counter_word) {
  const auto base = random_bits(1, RandomStage::noise, {2, 3, 4});
  EXPECT_EQ(base, random_bits(1, RandomStage::noise, {2, 3, 4}));
  EXPECT_NE(base, random_bits(2, RandomStage::noise, {2, 3, 4}));
  EXPECT_NE(base, random_bits(1, RandomStage::surfel_split, {2, 3, 4}));
  EXPECT_NE(base, random_bits(1, RandomStage::noise, {3, 3, 4}));
  EXPECT_NE(base, random_bits(1, RandomStage::noise, {2, 4, 4}));
  EXPECT_NE(base, random_bits(1, RandomStage::noise, {2, 3, 5}));
}

// Rayleigh amplitude: mean power 1, intensity contrast 1, circular phase. Standard errors are 1/sqrt(n).
TEST(Random, complex_normal_has_unit_power_and_exponential_intensity) {
  const int n = 200000;
  double power = 0, power2 = 0;
  std::complex<double> mean = 0, square = 0;
  for (int i = 0; i < n; ++i) {
    const auto z = random_complex_normal(42, RandomStage::surface_amplitude, {static_cast<std::uint64_t>(i), 0, 0});
    power += std::norm(z);
    power2 += std::norm(z) * std::norm(z);
    mean += z;
    square += z * z;
  }
  const double error = 5 / std::sqrt(n);  // five standard deviations
  EXPECT_NEAR(power / n, 1, error);
  EXPECT_NEAR(power2 / n, 2, 5 * error);
  EXPECT_LT(std::abs(mean) / n, error);
  EXPECT_LT(std::abs(square) / n, 2 * error);
}

TEST(Random, uniform_is_inside_the_open_interval) {
  for (std::uint64_t i = 0; i < 10000; ++i)
    for (const double u : random_uniform(7, RandomStage::ray_jitter, {i, 0, 0})) {
      EXPECT_GT(u, 0);
      EXPECT_LT(u, 1);
    }
}

TEST(Random, pairs_are_the_first_two_of_each_counter) {
  const std::uint64_t first[] = {0, 7, std::uint64_t{5} << 32 | 3};
  double u[3], v[3];
  random_uniform_pairs(11, RandomStage::surface_amplitude, first, 3, u, v);
  for (int i = 0; i < 3; ++i) {
    const auto one = random_uniform(11, RandomStage::surface_amplitude, {first[i], 0, 0});
    EXPECT_EQ(u[i], one[0]);
    EXPECT_EQ(v[i], one[1]);
  }
}

TEST(Random, complex_normals_of_many_counters_are_those_of_one) {
  constexpr std::size_t count = 300;
  const RandomCounter first{3, 5, 1000};
  std::vector<double> re(count), im(count);
  random_complex_normals(11, RandomStage::noise, first, count, re.data(), im.data());
  for (std::size_t i = 0; i < count; ++i) {
    const auto one = random_complex_normal(11, RandomStage::noise, {first.first, first.second, first.third + i});
    EXPECT_NEAR(re[i], one.real(), 2e-15) << i;
    EXPECT_NEAR(im[i], one.imag(), 2e-15) << i;
  }
}
