// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/environment.hpp"

#include <set>

#include "acoustics/noise.hpp"
#include "support/test.hpp"

namespace {

const double nan_value = std::numeric_limits<double>::quiet_NaN();

std::string refusal_of(const Environment& e) {
  return error_of([&] { require_valid(e, "here"); });
}

Environment with_boundaries(double surface, double bottom) {
  Environment e;
  e.surface = SeaSurface{surface};
  e.bottom = FlatBottom{bottom};
  return e;
}

}  // namespace

TEST(Environment, is_valid_by_default_and_with_everything_in_it) {
  EXPECT_EQ(refusal_of({}), "no error");
  Environment e = with_boundaries(0, -10);
  e.profile = SoundSpeedProfile{{0, 10}, {1500, 1490}};
  e.surface->rms_height = 0.1;
  e.surface->scattering_strength_db = -30;
  e.bottom->lambert_mu = 1 / pi;
  e.volume_scattering_db = -70;
  e.wind_speed = 5;
  e.self_noise_db = 40;
  EXPECT_EQ(refusal_of(e), "no error");
}

TEST(Environment, needs_the_bottom_below_the_surface) {
  EXPECT_EQ(refusal_of(with_boundaries(-8, -8)), "here: bottom.height = -8 m, must be below surface.height = -8 m");
  EXPECT_EQ(refusal_of(with_boundaries(-8, -8.5)), "no error");
}

TEST(Environment, names_the_key_value_unit_and_rule_it_refuses) {
  const auto refused = [](auto&& spoil) {
    Environment e = with_boundaries(0, -10);
    spoil(e);
    return refusal_of(e);
  };
  EXPECT_THAT(refused([](Environment& e) { e.surface->height = nan_value; }), HasSubstr("surface.height = nan m"));
  EXPECT_EQ(refused([](Environment& e) { e.surface->rms_height = -1; }),
            "here: surface.rms_height = -1 m, must be finite and >= 0");
  EXPECT_EQ(refused([](Environment& e) { e.surface->scattering_strength_db = 11; }),
            "here: surface.scattering_strength_db = 11 dB, must be finite and at most 10");
  EXPECT_THAT(refused([](Environment& e) { e.bottom->height = nan_value; }), HasSubstr("bottom.height = nan m"));
  EXPECT_EQ(refused([](Environment& e) { e.bottom->density_ratio = 0; }),
            "here: bottom.density_ratio = 0, must be > 0 and below 100");
  EXPECT_THAT(refused([](Environment& e) { e.bottom->sound_speed_ratio = 100; }),
              HasSubstr("bottom.sound_speed_ratio = 100, must be > 0 and below 100"));
  EXPECT_THAT(refused([](Environment& e) { e.bottom->loss = 1; }), HasSubstr("bottom.loss = 1, must be >= 0"));
  EXPECT_THAT(refused([](Environment& e) { e.bottom->rms_height = nan_value; }), HasSubstr("bottom.rms_height = nan"));
  EXPECT_EQ(refused([](Environment& e) { e.bottom->lambert_mu = 0.4; }),
            "here: bottom.lambert_mu = 0.4 1/sr, must be within 0 and 1/pi");
  EXPECT_EQ(refused([](Environment& e) { e.volume_scattering_db = 1; }),
            "here: volume.scattering_db = 1 dB, must be finite and at most 0");
  EXPECT_EQ(refused([](Environment& e) { e.wind_speed = 101; }),
            "here: wind_speed = 101 m/s, must be within 0 and 100");
  EXPECT_EQ(refused([](Environment& e) { e.self_noise_db = -401; }),
            "here: self_noise_db = -401 dB re 1 uPa^2/Hz, must be within -400 and 400");
  EXPECT_THAT(refused([](Environment& e) { e.water.salinity_psu = -1; }), HasSubstr("here: "));
}

TEST(Environment, medium_has_the_profiles_sound_speed_at_the_heads_depth) {
  Environment e;
  e.water.depth = 5;
  EXPECT_EQ(medium_of(e, 900e3).sound_speed, sound_speed(e.water));
  const double absorption = medium_of(e, 900e3).absorption.a0;
  e.profile = SoundSpeedProfile{{0, 10}, {1500, 1480}};
  EXPECT_DOUBLE_EQ(medium_of(e, 900e3).sound_speed, 1490);
  EXPECT_EQ(medium_of(e, 900e3).absorption.a0, absorption);
}

// On a rising tide the water changes a millimetre at a time; the sound speed is off by half of what a millimetre makes.
TEST(Environment, depths_of_heads_count_in_millimetres) {
  Environment e;
  e.water_level = 0;
  std::set<double> depths, speeds;
  for (int i = 0; i <= 100; ++i) {
    const double z = -12.34 + 1e-4 * i;
    const Environment there = environment_at(e, z, "test");
    depths.insert(there.water.depth);
    speeds.insert(medium_of(there, 300e3).sound_speed);
    EXPECT_NEAR(there.water.depth, -z, 0.5001e-3);
    Water exact = e.water;
    exact.depth = -z;
    EXPECT_NEAR(medium_of(there, 300e3).sound_speed, sound_speed(exact), 1e-5);
  }
  EXPECT_EQ(depths.size(), 11U);
  EXPECT_EQ(speeds.size(), 11U);
  EXPECT_EQ(head_depth(e, -2.7), 2.7);
}

TEST(Environment, slowest_sound_is_that_of_any_depth_a_head_may_have) {
  Environment e;
  e.water.depth = 5;
  EXPECT_EQ(slowest_sound(e), sound_speed(e.water));
  e.surface = SeaSurface{};
  EXPECT_EQ(slowest_sound(e), sound_speed(Water{}));
  e.profile = SoundSpeedProfile{{0, 10, 30}, {1500, 1480, 1490}};
  EXPECT_EQ(slowest_sound(e), 1480);
}

TEST(Environment, noise_is_the_power_sum_of_what_there_is) {
  const Pulse pulse{100e3, 1e3, 220};
  Environment e;
  const double thermal = thermal_noise_level_db(pulse);
  EXPECT_EQ(element_noise_level_db(e, pulse), thermal);
  e.self_noise_db = thermal_noise_spectrum_level_db(100e3);  // as much again
  EXPECT_NEAR(element_noise_level_db(e, pulse), thermal + 10 * std::log10(2.0), 1e-9);
  e.self_noise_db.reset();
  e.wind_speed = 5;
  EXPECT_NEAR(element_noise_level_db(e, pulse), ambient_noise_level_db(pulse, 5), 1e-9);
}
