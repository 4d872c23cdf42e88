// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/water.hpp"
#include "support/test.hpp"

namespace {

constexpr AbsorptionFormula all_formulas[] = {AbsorptionFormula::francois_garrison, AbsorptionFormula::fisher_simmons,
                                              AbsorptionFormula::ainslie_mccolm};
constexpr double table_khz[] = {50, 100, 450, 900, 1200, 3000};

double db_per_km(const Water& water, double khz, AbsorptionFormula formula = AbsorptionFormula::francois_garrison) {
  return absorption_db_per_m(water, khz * 1e3, formula) * 1e3;
}

}  // namespace

// Francois and Garrison (1982), evaluated independently from the paper's formulas, dB/km.
TEST(Absorption, follows_francois_and_garrison) {
  struct Case {
    Water water;
    double expected[6];
  };
  for (const Case& c : {Case{{10, 35, 0, 8}, {15.392, 33.630, 109.663, 299.463, 495.414, 2845.22}},
                        Case{{4, 35, 0, 8}, {15.143, 27.536, 111.524, 357.095, 611.482, 3663.62}},
                        Case{{20, 35, 0, 8}, {12.996, 38.059, 134.835, 274.234, 413.787, 2078.72}},
                        Case{{30, 35, 0, 8}, {9.744, 33.685, 184.635, 310.969, 419.776, 1676.47}},
                        Case{{10, 0, 0, 8}, {0.777, 3.108, 62.937, 251.748, 447.552, 2797.20}},
                        Case{{10, 7, 0, 8}, {3.733, 9.461, 73.002, 262.048, 457.887, 2807.574}},
                        Case{{10, 35, 1000, 8}, {13.325, 29.241, 100.735, 283.257, 471.784, 2732.73}}})
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(db_per_km(c.water, table_khz[i]), c.expected[i], 6e-4 + 2e-6 * c.expected[i])
          << table_khz[i] << " kHz, " << c.water.temperature_c << " deg C";
}

// Fisher and Simmons (1977), evaluated independently from the paper's formulas at 1 atm, dB/km with the paper's
// 8686 dB/km for 1 Np/m (exactly 8685.89).
TEST(Absorption, follows_fisher_and_simmons) {
  const double expected[] = {12.541, 30.807, 112.954, 307.604, 508.153, 2912.30};
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(db_per_km({10, 35, 0, 8}, table_khz[i], AbsorptionFormula::fisher_simmons), expected[i],
                6e-4 + 1.5e-5 * expected[i])
        << table_khz[i] << " kHz";
  EXPECT_NEAR(absorption_about({}, 900e3, 0, AbsorptionFormula::fisher_simmons).a0, 0.035414, 1e-6);
}

// Fisher and Simmons (1977), table IV as quoted by the oce package: 0.52 dB/km at 10 kHz, 4 to 5 deg C, 500 atm.
// The depths are those of 498 and 499 atm above the surface's own.
TEST(Absorption, of_fisher_and_simmons_at_500_atm_is_that_of_their_table) {
  const Water cold{4, 35, 4946.7221, 8}, mild{5, 35, 4956.5435, 8};
  EXPECT_NEAR(db_per_km(cold, 10, AbsorptionFormula::fisher_simmons), 0.5223, 1e-4);
  EXPECT_NEAR(db_per_km(mild, 10, AbsorptionFormula::fisher_simmons), 0.5120, 1e-4);
  EXPECT_NEAR(db_per_km(mild, 10, AbsorptionFormula::fisher_simmons), 0.52, 0.01);
}

// Ainslie and McColm (1998), evaluated independently from the paper's formula, dB/km.
TEST(Absorption, follows_ainslie_and_mccolm) {
  const double expected[] = {15.710, 34.341, 115.778, 322.309, 535.607, 3093.58};
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(db_per_km({10, 35, 0, 8}, table_khz[i], AbsorptionFormula::ainslie_mccolm), expected[i],
                6e-4 + 2e-6 * expected[i])
        << table_khz[i] << " kHz";
  const Water deep{4, 34, 3000, 7.9};
  EXPECT_NEAR(db_per_km(deep, 1, AbsorptionFormula::ainslie_mccolm), 0.0507237, 1e-7);
  EXPECT_NEAR(db_per_km(deep, 100, AbsorptionFormula::ainslie_mccolm), 17.49860, 1e-5);
  EXPECT_NEAR(db_per_km(deep, 900, AbsorptionFormula::ainslie_mccolm), 304.69455, 1e-5);
}

// The paper claims 10 %; 10.6 % is reached at 35 deg C, 40 psu, 1 MHz.
TEST(Absorption, of_ainslie_and_mccolm_is_within_11_percent_of_francois_and_garrison) {
  for (double t = -2; t <= 35; t += 1)
    for (double s = 30; s <= 40; s += 5)
      for (double khz : {0.1, 0.3, 1., 3., 10., 30., 100., 300., 1000.}) {
        const Water water{t, s, 0, 8};
        const double ratio = db_per_km(water, khz, AbsorptionFormula::ainslie_mccolm) / db_per_km(water, khz);
        EXPECT_NEAR(ratio, 1, 0.11) << t << " deg C, " << s << " psu, " << khz << " kHz";
      }
}

TEST(Absorption, formulas_differ_by_8_percent_at_900_khz) {
  double least = 1e9, most = 0;
  for (const auto formula : all_formulas) {
    least = std::min(least, db_per_km({}, 900, formula));
    most = std::max(most, db_per_km({}, 900, formula));
  }
  EXPECT_NEAR(most / least, 1.08, 0.005);
}

// The R package `sonar` prints 13.96602 dB/km at 50 kHz, 0 deg C, 35, pH 6 with theta = 273.15 + T; the paper's
// 273 + T, used here, gives 13.94619.
TEST(Absorption, uses_theta_of_the_paper) { EXPECT_NEAR(db_per_km({0, 35, 0, 6}, 50), 13.94619, 1e-4); }

// No salt, no relaxation: what is left is pure water, which grows with the square of frequency.
TEST(Absorption, of_fresh_water_is_finite_and_quadratic_in_frequency) {
  for (const auto formula : {AbsorptionFormula::francois_garrison, AbsorptionFormula::ainslie_mccolm})
    for (const double ph : {0.0, 7.0, 14.0}) {
      const Water fresh{10, 0, 0, ph};
      EXPECT_NEAR(db_per_km(fresh, 200, formula) / db_per_km(fresh, 100, formula), 4, 1e-12);
      const Absorption a = absorption_about(fresh, 900e3, 2, formula);
      EXPECT_NEAR(a.a1, 2 * a.a0 / 900e3, 1e-12 * a.a1);
      EXPECT_NEAR(a.a2, a.a0 / (900e3 * 900e3), 1e-12 * a.a2);
    }
}

// Boric acid alone depends on pH, as 10^(0.78 pH) and exp(pH / 0.56); it counts below 10 kHz only.
TEST(Absorption, depends_on_ph_through_boric_acid) {
  const auto step_ratio = [](AbsorptionFormula formula, double step) {
    const double low = db_per_km({10, 35, 0, 8 - step}, 1, formula), mid = db_per_km({10, 35, 0, 8}, 1, formula),
                 high = db_per_km({10, 35, 0, 8 + step}, 1, formula);
    return (high - mid) / (mid - low);
  };
  EXPECT_NEAR(step_ratio(AbsorptionFormula::francois_garrison, 1 / 0.78), 10, 1e-9);
  EXPECT_NEAR(step_ratio(AbsorptionFormula::ainslie_mccolm, 0.56), std::exp(1), 1e-9);
  EXPECT_EQ(db_per_km({10, 35, 0, 7.5}, 1, AbsorptionFormula::fisher_simmons),
            db_per_km({10, 20, 0, 8.2}, 1, AbsorptionFormula::fisher_simmons));
  EXPECT_NEAR(db_per_km({10, 35, 0, 7.7}, 900) / db_per_km({10, 35, 0, 8.3}, 900), 1, 1e-3);
}

TEST(Absorption, is_finite_and_positive_at_the_ends_of_every_input) {
  for (const auto formula : all_formulas)
    for (double t : {-4., 0., 20., 40.})
      for (double s : {0., 35., 300.})
        for (double z : {0., 12000.})
          for (double ph : {0., 8., 14.})
            for (double khz : {1e-3, 1., 100., 1e4}) {
              const Absorption a = absorption_about({t, s, z, ph}, khz * 1e3, 2, formula);
              EXPECT_TRUE(std::isfinite(a.a0) && a.a0 > 0 && std::isfinite(a.a1) && std::isfinite(a.a2))
                  << t << ' ' << s << ' ' << z << ' ' << ph << ' ' << khz;
            }
}

// Taylor coefficients against central differences of the function itself.
TEST(Absorption, taylor_coefficients_are_its_derivatives) {
  const Water water{10, 35, 500, 8};
  for (const auto formula : all_formulas)
    for (double f : {60e3, 900e3}) {
      const double h = 2e-3 * f;
      const Absorption a = absorption_about(water, f, 2, formula);
      const auto nepers = [&](double x) { return absorption_db_per_m(water, x, formula) * nepers_per_db; };
      EXPECT_NEAR(a.a0, nepers(f), 1e-15);
      EXPECT_NEAR(a.a1, (nepers(f + h) - nepers(f - h)) / (2 * h), 1e-5 * a.a1);
      EXPECT_NEAR(a.a2, (nepers(f + h) - 2 * nepers(f) + nepers(f - h)) / (2 * h * h), 1e-3 * std::abs(a.a2));
      EXPECT_EQ(absorption_about(water, f, 0, formula).a1, 0);
      EXPECT_EQ(absorption_about(water, f, 1, formula).a2, 0);
    }
}

TEST(Absorption, refuses_a_frequency_of_zero_and_an_unknown_order) {
  EXPECT_THROW(absorption_db_per_m({}, 0), Error);
  EXPECT_THROW(absorption_db_per_m({}, std::nan("")), Error);
  EXPECT_THROW(absorption_about({}, 900e3, 3), Error);
}

// The cubic for pure water of Fisher and Simmons turns negative near 75 deg C: sound would grow.
TEST(Absorption, that_would_make_sound_grow_is_refused) {
  EXPECT_GT(absorption_db_per_m({60, 35, 0, 8}, 900e3, AbsorptionFormula::fisher_simmons), 0);
  expect_error(ErrorKind::argument, {"the formula gives -", "temperature_c = 90 deg C"}, [] {
    absorption_db_per_m({90, 35, 0, 8}, 3e6, AbsorptionFormula::fisher_simmons);
  });
}

TEST(Absorption, steps_by_less_than_a_thousandth_where_the_branches_meet_at_20_degrees) {
  for (const double frequency : {50e3, 900e3, 3e6}) {
    const double below = absorption_db_per_m({20, 35, 0, 8}, frequency),
                 above = absorption_db_per_m({std::nextafter(20, 21), 35, 0, 8}, frequency);
    EXPECT_NEAR(above / below, 1, 1e-3) << frequency;
  }
}

// Boric acid's relaxation frequency is 0 in fresh water: 0 x 0 must not become 0 / 0.
TEST(Absorption, of_fresh_water_has_no_0_over_0) {
  for (const double ph : {0.0, 8.0, 14.0}) {
    const Water fresh{10, 0, 0, ph};
    EXPECT_NEAR(absorption_db_per_m(fresh, 900e3), 0.251748, 1e-6);
    EXPECT_NEAR(absorption_db_per_m({10, 1e-20, 0, ph}, 900e3), 0.251748, 1e-6);
  }
}

TEST(Absorption, outside_the_validity_of_the_formulas_is_computed) {
  for (const Water& water : {Water{-2, 35, 0, 8}, Water{45, 45, 0, 8}, Water{4, 35, 11000, 8}, Water{30, 0, 9000, 7}}) {
    const double c = sound_speed(water);
    EXPECT_GT(c, 1350) << water.temperature_c;
    EXPECT_LT(c, 1900) << water.temperature_c;
    const double alpha = absorption_db_per_m(water, 900e3);
    EXPECT_GT(alpha, 0.05) << water.temperature_c;
    EXPECT_LT(alpha, 1) << water.temperature_c;
  }
}
