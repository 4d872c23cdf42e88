// What is kept from image to image changes nothing but the time that an image takes.
#include "beamforming/kept_synthesizers.hpp"

#include <gtest/gtest.h>

#include "beamforming/ping_synthesizer.hpp"
#include "beamforming/true_delays/wideband_synthesizer.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "support/heads.hpp"

namespace {

using namespace insonify;

const Medium kept_medium{1490, {0.02, 0, 0}};

SonarHead kept_head() { return line_head({.beams = 9, .elements = 32, .min_range = 2, .max_range = 4}); }

/// Echoes in the gate with |u| up to `widest`.
Echoes spread_echoes(std::size_t count, double widest, std::uint64_t seed) {
  Echoes echoes;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = random_uniform(seed, RandomStage::scene_points, {i, 0, 0});
    echoes.delay.push_back(2 * (2 + 2 * at[0]) / kept_medium.sound_speed);
    echoes.u.push_back(widest * (2 * at[1] - 1));
    echoes.v.push_back(0.1 * (2 * at[2] - 1));
    echoes.amplitude.push_back(random_complex_normal(seed, RandomStage::noise, {i, 0, 0}));
  }
  return echoes;
}

}  // namespace

TEST(KeptSynthesizers, give_the_bytes_of_fresh_ones_in_any_order_and_from_several_threads) {
  SonarHead planar = kept_head();
  planar.column = planar.array;
  planar.fan.row_width = planar.fan.beam_width;
  KeptSynthesizers kept;
  for (const auto& [head, method] : {std::pair(kept_head(), SynthesisMethod::gridded),
                                     {kept_head(), SynthesisMethod::true_delays},
                                     {kept_head(), SynthesisMethod::element_exact},
                                     {planar, SynthesisMethod::gridded}}) {
    // Within the fan, and from all directions, for which true delays have other tables.
    std::vector<Echoes> pings;
    std::vector<ComplexGrid> fresh, images(8);
    for (std::size_t k = 0; k < images.size(); ++k) {
      pings.push_back(spread_echoes(300, k % 3 == 1 ? 0.99 : 0.6, k));
      fresh.push_back(synthesize(pings[k], head, kept_medium, method, {1e-3, 1}));
    }
    parallel_for(images.size(), 4, [&](std::size_t k) {
      images[k] = synthesize(pings[k], head, kept_medium, method, {1e-3, 1}, &kept);
    });
    for (std::size_t k = 0; k < images.size(); ++k) EXPECT_TRUE((images[k] == fresh[k]).all()) << k;
  }
}

TEST(KeptSynthesizers, are_made_once_for_each_head_medium_and_options) {
  KeptSynthesizers kept;
  const SonarHead head = kept_head();
  const auto first = kept.true_delays(head, kept_medium, {1e-3, 1});
  EXPECT_EQ(kept.true_delays(head, kept_medium, {1e-3, 1}), first);
  EXPECT_NE(kept.true_delays(head, kept_medium, {1e-4, 1}), first);
  EXPECT_NE(kept.true_delays(head, {1491, {0.02, 0, 0}}, {1e-3, 1}), first);
  SonarHead other = head;
  other.array.shading[0] += 1e-3, other.array.shading[1] -= 1e-3;
  EXPECT_NE(kept.true_delays(other, kept_medium, {1e-3, 1}), first);
  EXPECT_EQ(kept.true_delays(head, kept_medium, {1e-3, 1}), first);
  EXPECT_EQ(kept.narrow_band(head, kept_medium, {1e-3, 1}), kept.narrow_band(head, kept_medium, {1e-3, 1}));
}

TEST(KeptSynthesizers, are_no_more_than_asked_for) {
  KeptSynthesizers kept(2);
  const auto made_for = [&](double tolerance) { return kept.narrow_band(kept_head(), kept_medium, {tolerance, 1}); };
  const std::weak_ptr<const PingSynthesizer> a = made_for(1e-3), b = made_for(1e-4);
  (void)made_for(1e-3);
  (void)made_for(1e-5);
  EXPECT_FALSE(a.expired());
  EXPECT_TRUE(b.expired()) << "the one not used for the longest time goes";
}

// A head that dives has another medium in every ping, and does not come back to earlier ones.
TEST(KeptSynthesizers, of_one_head_are_those_of_the_last_two_media) {
  KeptSynthesizers kept;
  const auto made_in = [&](double sound_speed) {
    return kept.narrow_band(kept_head(), {sound_speed, {0.02, 0, 0}}, {1e-3, 1});
  };
  const std::weak_ptr<const PingSynthesizer> a = made_in(1490), b = made_in(1491), c = made_in(1492);
  EXPECT_TRUE(a.expired());
  EXPECT_FALSE(b.expired() || c.expired());
}

TEST(KeptSynthesizers, that_cannot_be_made_are_refused_every_time) {
  KeptSynthesizers kept;
  for (int k = 0; k < 2; ++k) EXPECT_THROW(kept.narrow_band(kept_head(), {-1, {}}, {1e-3, 1}), Error) << k;
}
