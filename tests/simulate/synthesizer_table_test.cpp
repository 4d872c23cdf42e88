// SPDX-License-Identifier: BSD-3-Clause
// Tests that tables for beams are made once for each medium, method and tolerance, and that the last few stay.
#include "simulate/synthesizer_table_internal.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

using Part = SynthesizerTable::Part;

const SonarHead table_head = line_head({.beams = 9, .elements = 32, .min_range = 2, .max_range = 4});

Medium medium_of_speed(double sound_speed) { return {sound_speed, {0.02, 0, 0}}; }

}  // namespace

TEST(SynthesizerTable, makes_one_for_each_part_medium_method_and_tolerance) {
  SynthesizerTable table;
  const auto image_of = [&](Part part, double sound_speed, SynthesisMethod method, double tolerance) {
    Echoes echo;
    echo.delay = {2 * 3.0 / 1490}, echo.u = {0.1}, echo.amplitude = {1.0};
    return table.of(part, table_head, medium_of_speed(sound_speed), method, {tolerance, 1})->pressure(echo);
  };
  using enum SynthesisMethod;
  for (int again = 0; again < 2; ++again)
    for (const double c : {1490.0, 1500.0})
      for (const SynthesisMethod method : {gridded, true_delays})
        for (const double tolerance : {1e-2, 1e-3}) {
          Echoes echo;
          echo.delay = {2 * 3.0 / 1490}, echo.u = {0.1}, echo.amplitude = {1.0};
          const ComplexGrid fresh = synthesize(echo, table_head, medium_of_speed(c), method, {tolerance, 1});
          for (const Part part : {Part::whole, Part::port_half})
            EXPECT_TRUE((image_of(part, c, method, tolerance) == fresh).all()) << c << ' ' << tolerance;
        }
}

TEST(SynthesizerTable, makes_each_once) {
  SynthesizerTable table;
  using enum SynthesisMethod;
  const auto of = [&](Part part, double sound_speed, SynthesisMethod method, double tolerance) {
    return table.of(part, table_head, medium_of_speed(sound_speed), method, {tolerance, 1});
  };
  const auto first = of(Part::whole, 1490, true_delays, 1e-3);
  EXPECT_EQ(of(Part::whole, 1490, true_delays, 1e-3), first);
  EXPECT_NE(of(Part::whole, 1490, true_delays, 1e-4), first);
  EXPECT_NE(of(Part::whole, 1490, gridded, 1e-3), first);
  EXPECT_NE(of(Part::whole, 1491, true_delays, 1e-3), first);
  EXPECT_NE(of(Part::port_half, 1490, true_delays, 1e-3), first);
  EXPECT_EQ(of(Part::whole, 1490, true_delays, 1e-3), first);
}

// A head that dives has another medium in every ping, and does not come back to earlier ones.
TEST(SynthesizerTable, keeps_those_of_the_last_two_media) {
  SynthesizerTable table;
  const auto made_in = [&](double sound_speed) {
    return table.of(Part::whole, table_head, medium_of_speed(sound_speed), SynthesisMethod::gridded, {1e-3, 1});
  };
  const std::weak_ptr<const Synthesizer> a = made_in(1490), b = made_in(1491);
  (void)made_in(1490);
  const std::weak_ptr<const Synthesizer> c = made_in(1492);
  EXPECT_FALSE(a.expired() || c.expired());
  EXPECT_TRUE(b.expired()) << "the one not used for the longest time goes";
}

TEST(SynthesizerTable, refuses_what_cannot_be_made_every_time) {
  SynthesizerTable table;
  for (int k = 0; k < 2; ++k)
    EXPECT_THROW(table.of(Part::whole, table_head, {-1, {}}, SynthesisMethod::gridded, {1e-3, 1}), Error) << k;
}

TEST(SynthesizerTable, keeps_what_draws_display_cells_by_medium_and_gate) {
  SynthesizerTable table;
  const auto first = table.cells_of(table_head, medium_of_speed(1490), 0.01);
  EXPECT_EQ(table.cells_of(table_head, medium_of_speed(1490), 0.01), first);
  SonarHead coarser = table_head;
  coarser.gate.bin_size *= 2;
  const auto other = table.cells_of(coarser, medium_of_speed(1490), 0.01);
  EXPECT_NE(other, first);
  EXPECT_EQ(table.cells_of(table_head, medium_of_speed(1490), 0.01), first);
  EXPECT_NE(table.cells_of(table_head, medium_of_speed(1491), 0.01), first);
  EXPECT_NE(table.cells_of(coarser, medium_of_speed(1490), 0.01), other) << "of three, the one used first is made anew";
}
