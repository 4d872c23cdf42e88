// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/water.hpp"

#include "support/test.hpp"

// Fofonoff and Millard (1983): 10000 dbar at 30 deg latitude in the standard ocean is a depth of 9712.653 m. Leroy
// and Parthiot's fit is good to about 1 part in 10^5.
TEST(GaugePressure, gives_the_published_depth_of_10000_dbar) {
  EXPECT_NEAR(gauge_pressure({.depth = 9712.653, .latitude_deg = 30}), 1e8, 1e3);
}

TEST(GaugePressure, grows_with_gravity_from_the_equator_to_either_pole) {
  const auto at = [](double latitude) { return gauge_pressure({.depth = 4000, .latitude_deg = latitude}); };
  EXPECT_LT(at(0), at(45));
  EXPECT_LT(at(45), at(90));
  EXPECT_EQ(at(-60), at(60));
  EXPECT_NEAR(at(90) / at(0), 9.832186 / 9.780318, 1e-5);  // gravity at pole and equator [m/s^2]
  EXPECT_EQ(gauge_pressure({.depth = 0, .latitude_deg = 70}), 0);
}

TEST(MediumOf, joins_sound_speed_and_absorption) {
  const Water water{4, 34, 300, 7.9, 60};
  for (const auto formula :
       {AbsorptionFormula::francois_garrison, AbsorptionFormula::fisher_simmons, AbsorptionFormula::ainslie_mccolm}) {
    const Medium medium = medium_of(water, 450e3, 2, formula);
    EXPECT_EQ(medium.sound_speed, sound_speed(water));
    EXPECT_EQ(medium.absorption.a0, absorption_about(water, 450e3, 2, formula).a0);
    EXPECT_EQ(medium.absorption.a2, absorption_about(water, 450e3, 2, formula).a2);
  }
  EXPECT_EQ(medium_of(water, 450e3).absorption.a0,
            absorption_about(water, 450e3, 0, AbsorptionFormula::francois_garrison).a0);
}

TEST(Water, impossible_values_are_refused_by_name) {
  const auto message_of = [](const Water& water) { return error_of([&] { require_valid(water, "somebody"); }); };
  EXPECT_EQ(message_of({}), "no error");
  EXPECT_EQ(message_of({.temperature_c = 101}), "somebody: temperature_c = 101 deg C, must be within -4 and 100");
  EXPECT_EQ(message_of({.salinity_psu = -1}), "somebody: salinity_psu = -1 psu, must be >= 0");
  EXPECT_EQ(message_of({.depth = -3}), "somebody: depth = -3 m, must be >= 0");
  EXPECT_EQ(message_of({.ph = 15}), "somebody: ph = 15, must be within 0 and 14");
  EXPECT_EQ(message_of({.latitude_deg = 91}), "somebody: latitude_deg = 91 deg, must be within -90 and 90");
  EXPECT_THAT(message_of({.latitude_deg = std::nan("")}), HasSubstr("latitude_deg = nan"));
}

TEST(Medium, of_no_sound_speed_or_of_growing_sound_is_refused) {
  EXPECT_NO_THROW(require_valid(Medium{1500, {0.03, 0, 0}}, "somebody"));
  for (const Medium& medium : {Medium{0, {}}, Medium{std::nan(""), {}}, Medium{1500, {-0.01, 0, 0}}})
    EXPECT_THROW(require_valid(medium, "somebody"), Error);
}
