// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/cut_pieces_internal.hpp"
#include "support/test.hpp"

TEST(CutEnergy, finds_where_relief_that_turns_away_returns_more_than_a_twentieth_and_beside) {
  CutEnergy energy;
  energy.all.fill(10);
  EXPECT_EQ(energy.hidden_by_relief(), RangeTenths<bool>{});
  energy.turned[4] = 0.45;
  EXPECT_EQ(energy.hidden_by_relief(), RangeTenths<bool>{});
  energy.turned[4] = 0.46, energy.turned[9] = 5;
  const RangeTenths<bool> found = energy.hidden_by_relief();
  EXPECT_EQ(found, (RangeTenths<bool>{false, false, false, true, true, true, false, false, true, true}));
  energy.turned.fill(0), energy.turned[0] = 1;
  EXPECT_TRUE(energy.hidden_by_relief()[0] && energy.hidden_by_relief()[1] && !energy.hidden_by_relief()[2]);
}

TEST(CutEnergy, of_all_parts_is_the_sum) {
  std::vector<CutPiece> pieces(3);
  for (CutPiece& piece : pieces) piece.energy.all[2] = 2, piece.energy.turned[7] = 0.5;
  const CutEnergy sum = energy_of(pieces);
  EXPECT_EQ(sum.all[2], 6);
  EXPECT_EQ(sum.turned[7], 1.5);
  EXPECT_EQ(sum.all[7], 0);
}

TEST(CutEnergy, has_the_ranges_in_ten_parts) {
  EXPECT_EQ(tenth_of(0, 20), 0U);
  EXPECT_EQ(tenth_of(5.9, 20), 2U);
  EXPECT_EQ(tenth_of(20, 20), 9U);
  EXPECT_EQ(tenth_of(21, 20), 9U);
}
