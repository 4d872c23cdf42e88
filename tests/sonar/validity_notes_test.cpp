// SPDX-License-Identifier: BSD-3-Clause
#include <tuple>

#include "sonar/water.hpp"
#include "support/test.hpp"

using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

namespace {
constexpr auto unesco = SoundSpeedFormula::unesco;
constexpr auto francois_garrison = AbsorptionFormula::francois_garrison;
}  // namespace

TEST(ValidityNotes, are_empty_for_the_default_water_and_a_fresh_tank_at_imaging_frequencies) {
  EXPECT_THAT(validity_notes({}, 900e3, unesco, francois_garrison), IsEmpty());
  EXPECT_THAT(validity_notes({20, 0, 0, 7}, 1e6, unesco, francois_garrison), IsEmpty());
}

// One step inside each edge is silent, one step outside gives exactly one note, naming the input.
TEST(ValidityNotes, begin_at_the_edges_the_header_states) {
  struct Edge {
    SoundSpeedFormula speed;
    AbsorptionFormula absorption;
    double khz;
    Water inside, outside;
    const char* input;
  };
  const auto mackenzie = SoundSpeedFormula::mackenzie, leroy = SoundSpeedFormula::leroy;
  const auto ainslie = AbsorptionFormula::ainslie_mccolm, fisher = AbsorptionFormula::fisher_simmons;
  const Water sea{10, 35, 0, 8};
  for (const Edge& e : {Edge{unesco, ainslie, 100, {0, 35, 0, 8}, {-0.1, 35, 0, 8}, "temperature_c"},
                        Edge{unesco, fisher, 100, {40, 35, 0, 8}, {40.1, 35, 0, 8}, "temperature_c"},
                        Edge{unesco, ainslie, 100, {10, 40, 0, 8}, {10, 40.1, 0, 8}, "salinity_psu"},
                        Edge{unesco, fisher, 100, {10, 35, 9700, 8}, {10, 35, 9701, 8}, "depth"},
                        Edge{mackenzie, ainslie, 100, {2, 35, 0, 8}, {1.9, 35, 0, 8}, "temperature_c"},
                        Edge{mackenzie, ainslie, 100, {30, 35, 0, 8}, {30.1, 35, 0, 8}, "temperature_c"},
                        Edge{mackenzie, ainslie, 100, {10, 25, 0, 8}, {10, 24.9, 0, 8}, "salinity_psu"},
                        Edge{mackenzie, ainslie, 100, {10, 40, 0, 8}, {10, 40.1, 0, 8}, "salinity_psu"},
                        Edge{mackenzie, fisher, 100, {10, 35, 8000, 8}, {10, 35, 8001, 8}, "depth"},
                        Edge{leroy, ainslie, 100, {-1, 35, 0, 8}, {-1.1, 35, 0, 8}, "temperature_c"},
                        Edge{leroy, ainslie, 100, {30, 35, 0, 8}, {30.1, 35, 0, 8}, "temperature_c"},
                        Edge{leroy, ainslie, 100, {10, 42, 0, 8}, {10, 42.1, 0, 8}, "salinity_psu"},
                        Edge{leroy, fisher, 100, {10, 35, 12000, 8}, {10, 35, 12001, 8}, "depth"},
                        Edge{unesco, ainslie, 100, {35, 35, 0, 8}, {35.1, 35, 0, 8}, "temperature_c"},
                        Edge{unesco, ainslie, 100, {10, 5, 0, 8}, {10, 4.9, 0, 8}, "salinity_psu"},
                        Edge{unesco, ainslie, 100, {10, 35, 7000, 8}, {10, 35, 7001, 8}, "depth"},
                        Edge{unesco, ainslie, 100, {10, 35, 0, 7.7}, {10, 35, 0, 7.6}, "ph"},
                        Edge{unesco, ainslie, 100, {10, 35, 0, 8.3}, {10, 35, 0, 8.4}, "ph"},
                        Edge{unesco, francois_garrison, 100, {22, 35, 0, 8}, {22.1, 35, 0, 8}, "temperature_c"},
                        Edge{unesco, francois_garrison, 100, {10, 30, 0, 8}, {10, 29.9, 0, 8}, "salinity_psu"},
                        Edge{unesco, francois_garrison, 100, {10, 35, 0, 8}, {10, 35.1, 0, 8}, "salinity_psu"},
                        Edge{unesco, francois_garrison, 100, {10, 35, 3500, 8}, {10, 35, 3501, 8}, "depth"},
                        Edge{unesco, francois_garrison, 900, {30, 35, 0, 8}, {30.1, 35, 0, 8}, "temperature_c"},
                        Edge{leroy, francois_garrison, 900, {0, 35, 0, 8}, {-0.1, 35, 0, 8}, "temperature_c"},
                        Edge{leroy, francois_garrison, 900, {10, 40, 0, 8}, {10, 40.1, 0, 8}, "salinity_psu"},
                        Edge{leroy, francois_garrison, 900, {10, 35, 10000, 8}, {10, 35, 10001, 8}, "depth"}}) {
    EXPECT_THAT(validity_notes(e.inside, e.khz * 1e3, e.speed, e.absorption), IsEmpty()) << e.input;
    EXPECT_THAT(validity_notes(e.outside, e.khz * 1e3, e.speed, e.absorption), ElementsAre(StartsWith(e.input)));
  }
  for (const auto& [formula, least_khz, most_khz] :
       {std::tuple{francois_garrison, 0.2, 1000.}, std::tuple{fisher, 10., 400.}, std::tuple{ainslie, 0.1, 1000.}}) {
    EXPECT_THAT(validity_notes(sea, 1e3 * least_khz, unesco, formula), IsEmpty());
    EXPECT_THAT(validity_notes(sea, 1e3 * most_khz, unesco, formula), IsEmpty());
    EXPECT_THAT(validity_notes(sea, 999 * least_khz, unesco, formula), ElementsAre(StartsWith("frequency")));
    EXPECT_THAT(validity_notes(sea, 1001 * most_khz, unesco, formula), ElementsAre(StartsWith("frequency")));
  }
}

TEST(ValidityNotes, say_value_unit_and_range_for_each_input_and_formula) {
  EXPECT_THAT(
      validity_notes({31, 20, 0, 8}, 3e6, SoundSpeedFormula::mackenzie, francois_garrison),
      ElementsAre("temperature_c = 31 deg C, but Mackenzie (1981) holds for 2 to 30 deg C: the sound speed is an "
                  "extrapolation",
                  "salinity_psu = 20 psu, but Mackenzie (1981) holds for 25 to 40 psu: the sound speed is an "
                  "extrapolation",
                  "temperature_c = 31 deg C, but Francois and Garrison (1982) from 500 kHz on holds for 0 to 30 deg "
                  "C: the absorption is an extrapolation",
                  "frequency = 3000 kHz, but Francois and Garrison (1982) from 500 kHz on holds for 0.2 to 1000 kHz: "
                  "the absorption is an extrapolation"));
  EXPECT_THAT(validity_notes({10, 35, 11000, 8}, 900e3, unesco, AbsorptionFormula::ainslie_mccolm),
              ElementsAre("depth = 11000 m, but UNESCO (Chen and Millero 1977) holds for 0 to 9700 m: the sound speed "
                          "is an extrapolation",
                          "depth = 11000 m, but Ainslie and McColm (1998) holds for 0 to 7000 m: the absorption is an "
                          "extrapolation"));
}

TEST(ValidityNotes, know_that_fisher_and_simmons_have_one_salinity_and_one_ph) {
  EXPECT_THAT(
      validity_notes({10, 33, 0, 7.9}, 100e3, SoundSpeedFormula::leroy, AbsorptionFormula::fisher_simmons),
      ElementsAre("salinity_psu = 33 psu, but Fisher and Simmons (1977) holds for 35 psu only: the absorption is an "
                  "extrapolation",
                  "ph = 7.9, but Fisher and Simmons (1977) holds for 8 only: the absorption is an extrapolation"));
}

// The paper's range is narrower where the relaxations count.
TEST(ValidityNotes, judge_fresh_water_by_frequency) {
  const Water lake{10, 0, 0, 7};
  EXPECT_THAT(validity_notes(lake, 500e3, unesco, francois_garrison), IsEmpty());
  EXPECT_THAT(validity_notes(lake, 499e3, unesco, francois_garrison),
              ElementsAre("salinity_psu = 0 psu, but Francois and Garrison (1982) below 500 kHz holds for 30 to 35 "
                          "psu: the absorption is an extrapolation"));
}

TEST(ValidityNotes, refuse_what_the_formulas_refuse) {
  EXPECT_THROW(validity_notes({.salinity_psu = -1}, 900e3, unesco, francois_garrison), Error);
  EXPECT_THROW(validity_notes({}, 0, unesco, francois_garrison), Error);
}
