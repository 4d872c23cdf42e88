// SPDX-License-Identifier: BSD-3-Clause
// Pings read one at a time: pages of a waterfall and sweeps.
#include "viewer/survey_window.hpp"

TEST(LazyPings, reads_what_is_asked_for_and_keeps_the_last) {
  const CountedReel counted;
  const LazyPings reel = counted.reel(1000, false);
  EXPECT_EQ(*counted.read, 0);
  EXPECT_EQ(reel.gate().bins(), 80U);
  EXPECT_EQ(*counted.read, 1);
  const std::weak_ptr<const Ping> first = reel.ping(7);
  EXPECT_EQ(reel.ping(7)->number, 7);
  EXPECT_EQ(*counted.read, 2);
  EXPECT_EQ(reel.ping(8)->number, 8);
  EXPECT_TRUE(first.expired());  // one is held, however many were read
  EXPECT_THAT(error_of([&] { reel.ping(1000); }, ErrorKind::argument), HasSubstr("must be below 1000"));
}

TEST(LazyPings, refuses_a_ping_of_another_extent) {
  std::vector<Ping> pings{one_beam_ping(0, false), one_beam_ping(1, false)};
  pings[1].gate.max_range = 8;
  pings[1].pressure.conservativeResize(1, 70);
  const LazyPings reel = reel_in_memory(pings);
  EXPECT_EQ(reel.fan().beams(), 1U);
  EXPECT_THAT(error_of([&] { reel.ping(1); }, ErrorKind::content), HasSubstr("ping 1 has 1 x 70 samples"));
}

TEST(ViewerRecords, a_page_holds_the_ping_and_at_most_600) {
  const LazyPings reel = CountedReel().reel(1301, false);
  for (const std::size_t ping : {0, 599, 600, 1199, 1200, 1300}) {
    const PageOfPings page = page_of(reel, ping);
    EXPECT_TRUE(page.first <= ping && ping < page.first + page.count) << ping;
    EXPECT_LE(page.count, 600U);
    EXPECT_GE(page.count, 2U);  // a waterfall of one row would be refused
  }
  EXPECT_EQ(page_of(reel, 599).first, page_of(reel, 0).first);  // the picture stays while the ping goes on
}

// After ping 14 of sweeps of twelve, bearings 0 to 2 are new, and the others those of the sweep before.
TEST(ViewerRecords, a_sweep_shows_every_bearing_as_it_was_heard_last) {
  ViewerData data;
  data.pings = CountedReel().reel(40, true);
  BeamPage page;
  const SweepImage sweep = sweep_at(data, 14, false, page);
  ASSERT_EQ(sweep.ping.size(), pings_per_sweep);
  for (std::size_t beam = 0; beam < pings_per_sweep; ++beam) {
    const std::size_t beam_azimuth = beam <= 2 ? 12 + beam : beam;
    EXPECT_EQ(sweep.ping[beam], beam_azimuth);
    EXPECT_NEAR(sweep.image.level_db(static_cast<Eigen::Index>(beam), 70),
                120 - 20 * std::log10(std::sqrt(2)) + static_cast<double>(beam_azimuth), 1e-3);
    EXPECT_NEAR(std::remainder(sweep.image.fan.azimuth[beam] - radians(30.0 * static_cast<double>(beam)), 2 * pi), 0,
                1e-12);
  }
  // In the first sweep nothing was received from the bearings to come.
  const SweepImage first = sweep_at(data, 3, false, page);
  EXPECT_EQ(first.image.level_db(4, 70), static_cast<float>(silence_db));
  EXPECT_GT(first.image.level_db(3, 70), 100);
  // The last sweep, of four pings, keeps the whole circle.
  EXPECT_EQ(sweep_at(data, 39, false, page).ping.size(), pings_per_sweep);
}
