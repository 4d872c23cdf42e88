// SPDX-License-Identifier: BSD-3-Clause
// Tests what changes the bits of a ping: seeds and velocity do, threads do not.
#include "acoustics/sound_speed_profile.hpp"
#include "support/checked_ping.hpp"
#include "support/point_targets.hpp"

namespace insonify::reproducible_ping {

TEST(ReproduciblePing, has_the_same_bits_with_one_to_seven_threads) {
  const SceneCloud scene = plate(6, 4, 40);
  for (const SamplingKind kind : {SamplingKind::surfels, SamplingKind::rays}) {
    const SimulatedPing one =
        ping_of(scene, {.sampling = {.kind = kind}, .outputs = {.scatterers = true}, .threads = 1});
    EXPECT_GT(one.outputs.scatterers.size(), 100U);
    for (const int threads : {2, 3, 4, 5, 6, 7}) {
      const SimulatedPing many =
          ping_of(scene, {.sampling = {.kind = kind}, .outputs = {.scatterers = true}, .threads = threads});
      EXPECT_TRUE((one.ping.pressure == many.ping.pressure).all()) << threads;
      EXPECT_EQ(one.outputs.scatterers.id, many.outputs.scatterers.id) << threads;
      EXPECT_EQ(one.soundings.bin, many.soundings.bin) << threads;
      EXPECT_EQ(one.soundings.level_db, many.soundings.level_db) << threads;
    }
  }
}

// 9 beams x some 60 cells of a plate, 40 pairs of seeds: the mean correlation of independent speckle is about
// 0.04, and the mean level has a standard deviation of 0.03 dB.
TEST(ReproduciblePing, has_other_speckle_of_the_same_level_with_another_seed) {
  const SceneCloud scene = plate(6, 4, 40);
  const auto seeded = [&](std::uint64_t seed) { return image(ping_of(scene, {.seed = seed})); };
  std::complex<double> product = 0;
  double power[2] = {0, 0};
  for (std::uint64_t k = 0; k < 40; ++k) {
    const ComplexGrid a = seeded(1 + 2 * k), b = seeded(2 + 2 * k);
    EXPECT_FALSE(same(a, b));
    product += (a * b.conjugate()).sum();
    power[0] += a.abs2().sum();
    power[1] += b.abs2().sum();
  }
  EXPECT_LT(std::abs(product) / std::sqrt(power[0] * power[1]), 0.05);
  EXPECT_NEAR(db_from_power(power[0] / power[1]), 0, 0.5);
  EXPECT_TRUE(same(seeded(3), seeded(3)));
  for (const std::uint64_t seed : {std::uint64_t{0}, ~std::uint64_t{0}}) EXPECT_TRUE(seeded(seed).isFinite().all());
}

// 2 m/s towards a patch at 30 m, 900 kHz, 1500 m/s: carrier up by 2 v f / (c - v) = 2403 Hz, range short by v / (c + v)
// of itself, 40 mm.
TEST(ReproduciblePing, of_a_head_approaching_at_2_m_per_s_has_2403_hz_more_and_40_mm_less) {
  const double r = 30, v = 2, c = 1500;
  SceneCloud scene;
  scene.origin = {r, 0, 0};
  add_surfel(scene, {r, 0, 0}, {-1, 0, 0}, 0.01);
  SonarHead head = single_beam({900e3, 29.5e3, 220}, 29.8, 30.2);
  head.fan.elevation_width = 1;
  Environment water;
  water.profile = SoundSpeedProfile{{0, 100}, {c, c}};
  const auto ping = [&](double speed) {
    SimulationOptions options;
    options.sampling.scatterers_per_cell = 0;
    options.amplitude = SurfaceAmplitude::coherent;
    options.synthesis.tolerance = 1e-7;
    options.effects.absorption_order = 0;  // its slope lowers the carrier by 1211 Hz
    return simulate_event(scene, head, {.motion = {.velocity = {speed, 0, 0}}}, water, options);
  };
  const auto peak_range = [&](const ComplexGrid& p, Eigen::Index& n) {
    p.row(0).abs().maxCoeff(&n);
    const double low = std::log(std::abs(p(0, n - 1))), mid = std::log(std::abs(p(0, n))),
                 high = std::log(std::abs(p(0, n + 1)));
    return head.gate.centre(static_cast<std::size_t>(n)) + 0.002 * 0.5 * (low - high) / (low - 2 * mid + high);
  };
  Eigen::Index n, at_rest;
  const ComplexGrid rest = image(ping(0)), closing = image(ping(v)), leaving = image(ping(-v));
  EXPECT_NEAR(peak_range(rest, at_rest), r, 1e-6);
  EXPECT_NEAR(peak_range(leaving, n) - r, r * v / (c - v), 2e-5);
  EXPECT_NEAR(peak_range(closing, n) - r, -r * v / (c + v), 2e-5);
  EXPECT_NEAR(r * v / (c + v), 0.040, 1e-4);

  // exp(-2 pi i f_d t): the phase turns by 2 pi f_d 2 dr / c from bin to bin.
  const double turn = -std::arg(closing(0, n + 3) * std::conj(closing(0, n - 3))) / 6;
  EXPECT_NEAR(turn / (2 * pi) * c / (2 * 0.002), 2403, 3);
  EXPECT_NEAR(std::arg(rest(0, at_rest) * std::conj(rest(0, at_rest - 1))), 0, 1e-6);
  // Over the pulse's length 1 / B that is half a radian: 2 pi 2403 / 29500 = 0.51.
  EXPECT_NEAR(2 * pi * 2403 / 29.5e3, 0.51, 0.005);
}

}  // namespace insonify::reproducible_ping
