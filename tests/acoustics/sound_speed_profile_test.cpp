// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/sound_speed_profile.hpp"

#include "support/test.hpp"

namespace {

const SoundSpeedProfile thermocline{{0, 10, 20}, {1510, 1500, 1502}};

std::string refusal(const SoundSpeedProfile& profile) {
  return error_of([&] { require_valid(profile, "test"); });
}

}  // namespace

TEST(SoundSpeedProfile, gives_its_entries_and_lines_between_them) {
  EXPECT_EQ(sound_speed_at(thermocline, 0), 1510);
  EXPECT_EQ(sound_speed_at(thermocline, 10), 1500);
  EXPECT_EQ(sound_speed_at(thermocline, 20), 1502);
  EXPECT_NEAR(sound_speed_at(thermocline, 2.5), 1507.5, 1e-12);
  EXPECT_NEAR(sound_speed_at(thermocline, 15), 1501, 1e-12);
}

TEST(SoundSpeedProfile, is_constant_beyond_its_outermost_entries) {
  EXPECT_EQ(sound_speed_at(thermocline, -3), 1510);
  EXPECT_EQ(sound_speed_at(thermocline, 1e6), 1502);
  EXPECT_EQ(sound_speed_at({{5}, {1490}}, -100), 1490);
  EXPECT_EQ(sound_speed_at({{5}, {1490}}, 100), 1490);
}

TEST(SoundSpeedProfile, is_refused_with_entry_value_and_rule) {
  EXPECT_EQ(refusal(thermocline), "no error");
  EXPECT_EQ(refusal({}), "test: sound speed profile has no entry, must have one at least");
  EXPECT_EQ(refusal({{0, 1}, {1500}}), "test: sound speed profile has 2 depths, but 1 sound speeds");
  EXPECT_EQ(refusal({{0, 2, 2}, {1500, 1500, 1500}}),
            "test: sound speed profile: depth[2] = 2 m, must be deeper than the entry before it, 2 m");
  EXPECT_EQ(refusal({{0, NAN}, {1500, 1500}}), "test: sound speed profile: depth[1] = nan m, must be finite");
  EXPECT_EQ(refusal({{0}, {343}}),
            "test: sound speed profile: sound_speed[0] = 343 m/s, must be within 1300 and 1700 m/s");
  EXPECT_NE(refusal({{0}, {NAN}}), "no error");
}
