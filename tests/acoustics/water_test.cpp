#include "acoustics/water.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/units.hpp"

using namespace insonify;

// Fofonoff and Millard (1983), p. 48: 1731.995 m/s at S = 40, T68 = 40 deg C (39.9904 on today's scale), p = 1000
// bar, which Leroy and Parthiot's formula reaches at the depth given.
TEST(SoundSpeed, unesco_gives_the_published_check_value) {
  EXPECT_NEAR(sound_speed({40 / 1.00024, 40, 9699.8885, 8}), 1731.995, 1e-3);
}

// Mackenzie (1981): 1550.744 m/s at 25 deg C, 35, 1000 m.
TEST(SoundSpeed, mackenzie_gives_the_published_check_value) {
  EXPECT_NEAR(sound_speed({25, 35, 1000, 8}, SoundSpeedFormula::mackenzie), 1550.744, 5e-4);
}

// Surface values of both formulas and of TEOS-10 (gsw 3.6.16: 1489.788, 1521.479, 1466.529, 1447.284).
TEST(SoundSpeed, unesco_agrees_with_teos10_to_10_cm_per_s) {
  EXPECT_NEAR(sound_speed({10, 35, 0, 8}), 1489.831, 1e-3);
  EXPECT_NEAR(sound_speed({10, 35, 0, 8}), 1489.788, 0.1);
  EXPECT_NEAR(sound_speed({20, 35, 0, 8}), 1521.479, 0.1);
  EXPECT_NEAR(sound_speed({4, 35, 0, 8}), 1466.529, 0.1);
  EXPECT_NEAR(sound_speed({10, 0, 0, 8}), 1447.284, 0.1);
  EXPECT_NEAR(sound_speed({10, 0, 0, 8}, SoundSpeedFormula::mackenzie), 1446.491, 1e-3);
}

TEST(SoundSpeed, refuses_impossible_water) {
  try {
    sound_speed({10, -1, 0, 8});
    FAIL() << "accepted a salinity of -1";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::argument);
    EXPECT_THAT(error.what(), testing::HasSubstr("salinity_psu = -1 psu, must be >= 0"));
  }
  EXPECT_THROW(sound_speed({10, 35, -3, 8}), Error);
  EXPECT_THROW(sound_speed({std::nan(""), 35, 0, 8}), Error);
}

// Francois and Garrison (1982), evaluated independently in numpy from the paper's formulas, dB/km.
TEST(Absorption, follows_francois_and_garrison) {
  struct Case {
    Water water;
    double khz, db_per_km;
  };
  const Water cold{4, 35, 0, 8}, mild{10, 35, 0, 8}, warm{30, 35, 0, 8}, fresh{10, 0, 0, 8}, deep{10, 35, 1000, 8};
  for (const Case& c :
       {Case{mild, 50, 15.392}, Case{mild, 100, 33.630}, Case{mild, 450, 109.663}, Case{mild, 900, 299.463},
        Case{mild, 1200, 495.414}, Case{mild, 3000, 2845.22}, Case{cold, 900, 357.095}, Case{warm, 900, 310.969},
        Case{fresh, 900, 251.748}, Case{fresh, 50, 0.777}, Case{deep, 900, 283.257}})
    EXPECT_NEAR(absorption_db_per_m(c.water, c.khz * 1e3) * 1e3, c.db_per_km, 6e-4 + 1e-5 * c.db_per_km)
        << c.khz << " kHz";
}

// The R package `sonar` prints 13.96602 dB/km at 50 kHz, 0 deg C, 35, pH 6 with theta = 273.15 + T; the paper's
// 273 + T, used here, gives 13.94619.
TEST(Absorption, uses_theta_of_the_paper) {
  EXPECT_NEAR(absorption_db_per_m({0, 35, 0, 6}, 50e3) * 1e3, 13.94619, 1e-4);
}

TEST(Absorption, jumps_by_less_than_a_thousandth_where_the_branches_meet) {
  const double below = absorption_db_per_m({20, 35, 0, 8}, 900e3),
               above = absorption_db_per_m({20.0001, 35, 0, 8}, 900e3);
  EXPECT_NEAR(above / below, 1, 1e-3);
}

// Taylor coefficients against central differences of the function itself.
TEST(Absorption, taylor_coefficients_are_its_derivatives) {
  const Water water;
  const double f = 900e3, h = 2e3;
  const Absorption a = absorption_about(water, f, 2);
  const auto nepers = [&](double x) { return absorption_db_per_m(water, x) * nepers_per_db; };
  EXPECT_NEAR(a.a0, nepers(f), 1e-15);
  EXPECT_NEAR(a.a1, (nepers(f + h) - nepers(f - h)) / (2 * h), 1e-5 * a.a1);
  EXPECT_NEAR(a.a2, (nepers(f + h) - 2 * nepers(f) + nepers(f - h)) / (2 * h * h), 1e-3 * a.a2);
  EXPECT_EQ(absorption_about(water, f, 0).a1, 0);
  EXPECT_EQ(absorption_about(water, f, 1).a2, 0);
}

TEST(Absorption, refuses_a_frequency_of_zero) { EXPECT_THROW(absorption_db_per_m({}, 0), Error); }
