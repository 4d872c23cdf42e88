// SPDX-License-Identifier: BSD-3-Clause
// Tests that tables kept from image to image change only the time of an image.
#include "beamforming/synthesizer.hpp"

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "support/heads.hpp"

namespace {

using namespace insonify;

const Medium synthesizer_medium{1490, {0.02, 0, 0}};

SonarHead synthesizer_head() { return line_head({.beams = 9, .elements = 32, .min_range = 2, .max_range = 4}); }

/// Returns echoes in the gate with |u| up to `widest`.
Echoes spread_echoes(std::size_t count, double widest, std::uint64_t seed) {
  Echoes echoes;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = random_uniform(seed, RandomStage::scene_points, {i, 0, 0});
    echoes.delay.push_back(2 * (2 + 2 * at[0]) / synthesizer_medium.sound_speed);
    echoes.u.push_back(widest * (2 * at[1] - 1));
    echoes.v.push_back(0.1 * (2 * at[2] - 1));
    echoes.amplitude.push_back(random_complex_normal(seed, RandomStage::noise, {i, 0, 0}));
  }
  return echoes;
}

}  // namespace

TEST(Synthesizers, give_the_bytes_of_fresh_ones_in_any_order_and_from_several_threads) {
  SonarHead planar = synthesizer_head();
  planar.column = planar.array;
  planar.fan.row_width = planar.fan.beam_width;
  for (const auto& [head, method] : {std::pair(synthesizer_head(), SynthesisMethod::gridded),
                                     {synthesizer_head(), SynthesisMethod::true_delays},
                                     {synthesizer_head(), SynthesisMethod::element_exact},
                                     {planar, SynthesisMethod::gridded}}) {
    // Take echoes within the fan, then from all directions, for which true delays have other tables.
    std::vector<Echoes> pings;
    std::vector<ComplexGrid> fresh, images(8);
    for (std::size_t k = 0; k < images.size(); ++k) {
      pings.push_back(spread_echoes(300, k % 3 == 1 ? 0.99 : 0.6, k));
      fresh.push_back(synthesize(pings[k], head, synthesizer_medium, method, {1e-3, 1}));
    }
    const Synthesizer synthesizer(head, synthesizer_medium, method, {1e-3, 1});
    const Synthesizer copy = synthesizer;
    parallel_for(images.size(), 4,
                 [&](std::size_t k) { images[k] = (k % 2 == 0 ? synthesizer : copy).pressure(pings[k]); });
    for (std::size_t k = 0; k < images.size(); ++k) EXPECT_TRUE((images[k] == fresh[k]).all()) << k;
  }
}

TEST(Synthesizers, that_cannot_be_made_are_refused) {
  EXPECT_THROW(Synthesizer(synthesizer_head(), {-1, {}}), Error);
  EXPECT_THROW(Synthesizer(synthesizer_head(), synthesizer_medium, SynthesisMethod::gridded, {.tolerance = 0}), Error);
  // Refusals of one method occur in every image.
  const Synthesizer too_fine(synthesizer_head(), synthesizer_medium, SynthesisMethod::gridded, {.tolerance = 1e-15});
  for (int k = 0; k < 2; ++k) EXPECT_THROW(too_fine.pressure(spread_echoes(3, 0.5, 1)), Error) << k;
}
