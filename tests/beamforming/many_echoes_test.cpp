// SPDX-License-Identifier: BSD-3-Clause
// Ten million echoes, and a million in one bin: bounded memory, sums that add up.
#include "beamforming/gridded/gridded_engine.hpp"
#include "beamforming/synthesize.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "files/peak_memory.hpp"
#include "support/point_targets.hpp"
#include "support/sanitizers.hpp"

namespace insonify::many_echoes {

constexpr std::size_t many = sanitized ? 300000 : 10000000;
constexpr double sound = c0;

SonarHead modest_head() {
  SonarSpec s = nine_beams();
  s.beams = 64;
  s.bandwidth = 30e3;
  s.min_range = 1;
  s.bin_size = 0.44 * sound / (2 * s.bandwidth);
  s.max_range = s.min_range + 499.5 * *s.bin_size;
  return make_head(s, sound);
}

/// Echoes [first, last) of an unlimited random sequence.
Echoes crowd(const SonarHead& head, std::size_t first, std::size_t last) {
  Echoes e;
  e.delay.resize(last - first), e.u.resize(last - first), e.amplitude.resize(last - first);
  parallel_blocks(last - first, 65536, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto at = random_uniform(11, RandomStage::scene_points, {first + k, 0, 0});
      e.delay[k] = 2 * (head.gate.min_range + (head.gate.max_range - head.gate.min_range) * at[0]) / sound;
      e.u[k] = 0.6 * (at[1] - 0.5);
      e.amplitude[k] = {at[2] - 0.5, at[3] - 0.5};
    }
  });
  return e;
}

// Beside the echoes: 4 bytes for every tile that an echo touches (one or two of 64 bins, on average 1.25), the image, a
// tile per thread, the counters of TileLists, and 8 MiB for whatever else the process does.
TEST(TenMillionEchoes, ten_million_echoes_take_no_more_memory_than_lists_image_and_tiles) {
  const SonarHead head = modest_head();
  Medium medium;
  medium.sound_speed = sound;
  const double tolerance = 1e-4;
  const GriddedEngine plan(head, medium, {tolerance, 2});
  ComplexGrid whole;
  {
    const Echoes all = crowd(head, 0, many);
    plan.pressure(crowd(head, 0, 20000));  // libraries, threads and their stacks
    forget_peak_memory();
    const double before = peak_memory_mib();
    whole = plan.pressure(all);
    const double lists = 4 * 1.25 * static_cast<double>(many), image = 16.0 * static_cast<double>(whole.size());
    const double tiles = 2 * plan.choice().bytes_per_thread * 2;  // twice: flushed sums, and pulse samples
    const double bound = (lists + image + tiles) / 0x1p20 + 8;
    if (!sanitized) {
      EXPECT_LE(peak_memory_mib() - before, bound);
      EXPECT_LT(bound, 80);
    }
  }
  EXPECT_TRUE(whole.isFinite().all());

  // The image of all is the sum of the images of its halves.
  ComplexGrid sum = plan.pressure(crowd(head, 0, many / 2));
  sum += plan.pressure(crowd(head, many / 2, many));
  EXPECT_LE(relative_l2(whole, sum), 2 * tolerance);
}

// A million echoes of one bin at 48 positions: direct sum over the positions with the sum of their amplitudes.
TEST(ManyEchoes, a_million_echoes_in_one_bin_keep_the_tolerance_in_single_precision) {
  constexpr std::size_t count = sanitized ? 50000 : 1000000, positions = 48;
  const SonarHead head = modest_head();
  Medium medium;
  medium.sound_speed = sound;
  for (const bool alike : {true, false}) {
    Echoes e, sums = crowd(head, 0, positions);
    for (std::size_t k = 0; k < positions; ++k) {
      const double bin = 250 + 0.9 * static_cast<double>(k) / positions;
      sums.delay[k] = 2 * (head.gate.centre(0) + bin * head.gate.bin_size) / sound;
      sums.amplitude[k] = 0;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto at = random_uniform(12, RandomStage::noise, {i, 0, 0});
      const std::complex<double> a = alike ? 1.0 : std::complex<double>(at[0] - 0.5, at[1] - 0.5);
      e.delay.push_back(sums.delay[i % positions]);
      e.u.push_back(sums.u[i % positions]);
      e.amplitude.push_back(a);
      sums.amplitude[i % positions] += a;
    }
    const GriddedEngine plan(head, medium, {1e-4, 0});
    ASSERT_TRUE(plan.choice().single_precision);
    EXPECT_LE(relative_l2(plan.pressure(e), synthesize_direct(sums, head, medium)), 1e-4) << alike;
  }
}

}  // namespace insonify::many_echoes
