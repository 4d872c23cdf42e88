// Water beyond its formulas' ranges.
#include "extreme_cases.hpp"

using namespace insonify::extreme;

TEST(ExtremeWater, n45_sound_speed_of_zero_or_no_number_is_refused) {
  for (const double c : {0.0, -1500.0, not_a_number, infinity}) {
    expect_error(ErrorKind::argument, {"make_head: sound_speed = ", "m/s", "> 0"},
                 [&] { make_head(small_sonar(), c); });
    const SonarHead head = small_head();
    const Echoes echoes = echoes_of(targets_at({5}), head.pulse, clear_water());
    expect_error(ErrorKind::argument, {"sound_speed = ", "m/s", "> 0"}, [&] {
      synthesize_gridded(echoes, head, {c, {}});
    });
    expect_error(ErrorKind::argument, {"sound_speed = ", "m/s", "> 0"}, [&] {
      echoes_of(targets_at({5}), head.pulse, {c, {}});
    });
  }
}

TEST(ExtremeWater, n46_water_outside_the_formulas_validity_is_computed) {
  for (const Water& water : {Water{-2, 35, 0, 8}, Water{45, 45, 0, 8}, Water{4, 35, 11000, 8}, Water{30, 0, 9000, 7}}) {
    const double c = sound_speed(water);
    EXPECT_GT(c, 1350) << water.temperature_c;
    EXPECT_LT(c, 1900) << water.temperature_c;
    const double alpha = absorption_db_per_m(water, 900e3);
    EXPECT_GT(alpha, 0.05) << water.temperature_c;
    EXPECT_LT(alpha, 1) << water.temperature_c;
  }
}

TEST(ExtremeWater, n46_water_that_cannot_be_is_refused) {
  const auto refused = [](const Water& water, const std::vector<std::string>& parts) {
    expect_error(ErrorKind::argument, parts, [&] { sound_speed(water); });
    expect_error(ErrorKind::argument, parts, [&] { absorption_db_per_m(water, 900e3); });
    expect_error(ErrorKind::argument, parts, [&] { ping_of(plate(5, 1, 3), {}, small_sonar(), water); });
  };
  refused({not_a_number, 35, 0, 8}, {"temperature_c = nan"});
  refused({300, 35, 0, 8}, {"temperature_c = 300"});
  refused({10, -1, 0, 8}, {"salinity_psu = -1"});
  refused({10, 35, -5, 8}, {"depth = -5 m"});
  refused({10, 35, 0, 15}, {"ph = 15"});
}

// Boric acid's relaxation frequency is 0 in fresh water: 0 x 0 must not become 0 / 0.
TEST(ExtremeWater, n47_fresh_water_absorbs_by_its_own_term_alone) {
  for (const double ph : {0.0, 8.0, 14.0}) {
    const Water fresh{10, 0, 0, ph};
    EXPECT_NEAR(absorption_db_per_m(fresh, 900e3), 0.251748, 1e-6);
    EXPECT_NEAR(absorption_db_per_m(fresh, 1800e3) / absorption_db_per_m(fresh, 900e3), 4, 1e-12);
    const Absorption a = absorption_about(fresh, 900e3, 2);
    EXPECT_NEAR(a.a1 * 900e3 / a.a0, 2, 1e-12);
    EXPECT_NEAR(a.a2 * 900e3 * 900e3 / a.a0, 1, 1e-12);
    EXPECT_NEAR(absorption_db_per_m({10, 1e-20, 0, ph}, 900e3), 0.251748, 1e-6);
  }
}

TEST(ExtremeWater, n48_absorption_steps_by_less_than_a_thousandth_at_20_degrees) {
  for (const double frequency : {50e3, 900e3, 3e6}) {
    const double below = absorption_db_per_m({20, 35, 0, 8}, frequency),
                 above = absorption_db_per_m({std::nextafter(20, 21), 35, 0, 8}, frequency);
    EXPECT_NEAR(above / below, 1, 1e-3) << frequency;
  }
}
