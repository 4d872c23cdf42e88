// SPDX-License-Identifier: BSD-3-Clause
// The first return of a bottom, in rows made for it.
#include "returns/first_return.hpp"

#include "support/test.hpp"

namespace {

constexpr RangeGate bed_gate{0.01, 30.01, 0.03};

/// Returns one look of speckle: water of -40 dB, and a bed of 0 dB from `bed` [m] on.
Grid<float> speckled_row(double bed, unsigned seed) {
  std::mt19937 random(seed);
  std::exponential_distribution<double> intensity(1);
  Grid<float> row(1, static_cast<Eigen::Index>(bed_gate.bins()));
  for (Eigen::Index n = 0; n < row.cols(); ++n) {
    const double mean = bed_gate.centre(static_cast<std::size_t>(n)) < bed ? 1e-4 : 1;
    row(0, n) = static_cast<float>(db_from_power(mean * intensity(random)));
  }
  return row;
}

}  // namespace

// A step of 40 dB is found within three bins, whatever the speckle.
TEST(FirstReturn, is_where_the_bed_begins) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const double bed = 2 + 0.13 * seed;
    const auto found = first_return(speckled_row(bed, seed), bed_gate);
    ASSERT_TRUE(found.has_value()) << seed;
    EXPECT_NEAR(*found, bed, 0.09) << seed;
  }
}

TEST(FirstReturn, is_behind_the_transmission) {
  Grid<float> row = speckled_row(12, 3);
  row.middleCols(18, 12).setConstant(30);  // ringing at 0.55 to 0.9 m
  EXPECT_NEAR(first_return(row, bed_gate).value(), 12, 0.09);
}

TEST(FirstReturn, passes_over_faint_echoes_in_silent_water) {
  Grid<float> row = speckled_row(12, 3);
  row.leftCols(390).setConstant(-200);
  row(0, 200) = -60;  // a side lobe
  EXPECT_NEAR(first_return(row, bed_gate).value(), 12, 0.09);
}

TEST(FirstReturn, is_absent_without_a_bed) {
  EXPECT_FALSE(first_return(speckled_row(100, 4), bed_gate).has_value());
  EXPECT_FALSE(first_return(Grid<float>::Constant(1, 1000, -200.0F), bed_gate).has_value());
  EXPECT_FALSE(first_return(Grid<float>::Constant(1, 10, 0.0F), {0.01, 0.31, 0.03}).has_value());
  EXPECT_THAT(error_of([] { first_return(Grid<float>::Constant(2, 1000, 0.0F), bed_gate); }),
              HasSubstr("a row of 2 x 1000 levels, must be 1 x 1000"));
}
