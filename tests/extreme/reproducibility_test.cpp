// Threads and seeds.
#include "extreme_cases.hpp"

using namespace insonify::extreme;

TEST(Reproducibility, n49_one_to_seven_threads_give_the_same_bits) {
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

TEST(Reproducibility, n49_every_synthesis_gives_the_same_bits_for_any_number_of_threads) {
  const SonarHead head = small_head();
  const Echoes echoes = echoes_of(targets_at({2, 3, 5, 5.001, 7, 11.9}, 0.1), head.pulse, clear_water());
  for (const auto synthesize : {synthesize_direct, synthesize_gridded, synthesize_spectrum}) {
    const ComplexGrid one = synthesize(echoes, head, clear_water(), {.threads = 1});
    for (const int threads : {2, 3, 4, 5, 6, 7})
      EXPECT_TRUE(same(synthesize(echoes, head, clear_water(), {.threads = threads}), one)) << threads;
  }
}

// 9 beams x some 60 cells of a plate, 40 pairs of seeds: the mean correlation of independent speckle is about
// 0.04, and the mean level has a standard deviation of 0.03 dB.
TEST(Reproducibility, n50_another_seed_gives_other_speckle_of_the_same_level) {
  const SceneCloud scene = plate(6, 4, 40);
  const auto seeded = [&](std::uint64_t seed) { return image(ping_of(scene, {.seed = seed})); };
  Complex product = 0;
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
