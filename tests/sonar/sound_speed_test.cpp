// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/water.hpp"
#include "support/test.hpp"

// Fofonoff and Millard (1983), p. 48: 1731.995 m/s at S = 40, T68 = 40 deg C (39.9904 on today's scale), p = 1000
// bar, which Leroy and Parthiot's formula reaches at the depth given. The oce package gives 1522.96 m/s at S = 35,
// T68 = 10 deg C, p = 200 bar.
TEST(SoundSpeed, unesco_gives_the_published_check_value) {
  EXPECT_NEAR(sound_speed({40 / 1.00024, 40, 9699.9335, 8}), 1731.995, 1e-3);
  EXPECT_NEAR(sound_speed({10 / 1.00024, 35, 1974.3463, 8}), 1522.96, 5e-3);
}

// Mackenzie (1981): 1550.744 m/s at 25 deg C, 35, 1000 m. MBARI's table: 1718.774 m/s at 40 deg C, 40, 10000 m.
TEST(SoundSpeed, mackenzie_gives_the_published_check_value) {
  EXPECT_NEAR(sound_speed({25, 35, 1000, 8}, SoundSpeedFormula::mackenzie), 1550.744, 5e-4);
  EXPECT_NEAR(sound_speed({40, 40, 10000, 8}, SoundSpeedFormula::mackenzie), 1718.774, 1e-3);
}

// The table of the SonarDocs page on this equation (gorbatschow.github.io/SonarDocs/sound_speed_sea_npl.en): 30 psu
// on the equator, rounded or cut to 0.01 m/s.
TEST(SoundSpeed, leroy_gives_a_published_table) {
  const double depth[] = {10, 1000, 2000, 5000}, temperature[] = {0, 10, 20, 30, 40};
  const double table[4][5] = {{1442.56, 1483.90, 1516.14, 1540.55, 1558.38},
                              {1458.62, 1499.98, 1532.31, 1556.85, 1574.88},
                              {1475.31, 1516.64, 1548.98, 1573.61, 1591.78},
                              {1527.74, 1568.04, 1599.55, 1623.51, 1641.20}};
  for (int z = 0; z < 4; ++z)
    for (int t = 0; t < 5; ++t)
      EXPECT_NEAR(sound_speed({temperature[t], 30, depth[z], 8, 0}, SoundSpeedFormula::leroy), table[z][t], 0.01)
          << temperature[t] << " deg C, " << depth[z] << " m";
}

// Evaluated independently from the papers' formulas; TEOS-10 by gsw 3.6.16 (sound_speed_t_exact).
TEST(SoundSpeed, surface_values_of_the_three_formulas_and_of_teos10) {
  struct Case {
    double temperature_c, salinity_psu, mackenzie, unesco, leroy, teos10;
  };
  for (const Case& c :
       {Case{10, 35, 1489.803, 1489.831, 1489.819, 1489.788}, Case{20, 35, 1521.463, 1521.475, 1521.578, 1521.479},
        Case{4, 35, 1466.491, 1466.624, 1466.520, 1466.529}, Case{10, 0, 1446.491, 1447.280, 1447.270, 1447.284}}) {
    const Water water{c.temperature_c, c.salinity_psu, 0, 8};
    EXPECT_NEAR(sound_speed(water, SoundSpeedFormula::mackenzie), c.mackenzie, 1e-3);
    EXPECT_NEAR(sound_speed(water), c.unesco, 1e-3);
    EXPECT_NEAR(sound_speed(water, SoundSpeedFormula::leroy), c.leroy, 1e-3);
    EXPECT_NEAR(sound_speed(water), c.teos10, 0.1);
    EXPECT_NEAR(sound_speed(water, SoundSpeedFormula::leroy), c.teos10, 0.2);
  }
}

TEST(SoundSpeed, the_three_formulas_agree_to_31_cm_per_s_at_the_surface_of_the_sea) {
  for (double t = 2; t <= 30; t += 2)
    for (double s = 30; s <= 40; s += 2.5) {
      const Water water{t, s, 0, 8};
      EXPECT_NEAR(sound_speed(water, SoundSpeedFormula::mackenzie), sound_speed(water), 0.31) << t << ' ' << s;
      EXPECT_NEAR(sound_speed(water, SoundSpeedFormula::leroy), sound_speed(water), 0.2) << t << ' ' << s;
    }
}

// UNESCO takes latitude through gravity and pressure, Leroy through a term of its own.
TEST(SoundSpeed, latitude_counts_at_depth_alike_in_unesco_and_leroy) {
  const auto pole_less_equator = [](double depth, SoundSpeedFormula formula) {
    return sound_speed({2, 35, depth, 8, 90}, formula) - sound_speed({2, 35, depth, 8, 0}, formula);
  };
  EXPECT_NEAR(pole_less_equator(5000, SoundSpeedFormula::leroy), 0.54, 1e-9);
  EXPECT_NEAR(pole_less_equator(5000, SoundSpeedFormula::unesco), 0.54, 0.1);
  EXPECT_EQ(pole_less_equator(5000, SoundSpeedFormula::mackenzie), 0);
  for (const auto formula : {SoundSpeedFormula::unesco, SoundSpeedFormula::leroy}) {
    EXPECT_EQ(pole_less_equator(0, formula), 0);
    EXPECT_EQ(sound_speed({2, 35, 3000, 8, -50}, formula), sound_speed({2, 35, 3000, 8, 50}, formula));
  }
}

TEST(SoundSpeed, and_absorption_refuse_impossible_water) {
  for (const auto& [water, part] : {std::pair{Water{std::nan(""), 35, 0, 8}, "temperature_c = nan"},
                                    {Water{300, 35, 0, 8}, "temperature_c = 300"},
                                    {Water{10, -1, 0, 8}, "salinity_psu = -1 psu, must be >= 0"},
                                    {Water{10, 35, -5, 8}, "depth = -5 m"},
                                    {Water{10, 35, 0, 15}, "ph = 15"}}) {
    expect_error(ErrorKind::argument, {"sound_speed: ", part}, [&, w = water] { sound_speed(w); });
    expect_error(ErrorKind::argument, {part}, [&, w = water] { absorption_db_per_m(w, 900e3); });
  }
}

TEST(SoundSpeed, refuses_water_where_the_formula_is_absurd) {
  expect_error(ErrorKind::argument, {"sound_speed: the formula gives -", "depth = 1000000 m"}, [] {
    sound_speed({10, 35, 1e6, 8}, SoundSpeedFormula::leroy);
  });
}
