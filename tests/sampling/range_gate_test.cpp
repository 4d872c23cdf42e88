// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/range_gate.hpp"

#include "sampling_scenes.hpp"
#include "support/test.hpp"

TEST(RangeGate, has_enough_bins_to_cover_its_far_end) {
  EXPECT_EQ((RangeGate{1, 2, 0.25}).bins(), 4u);
  EXPECT_EQ((RangeGate{1, 2, 0.3}).bins(), 4u);
  EXPECT_EQ((RangeGate{0.5, 9.3, 0.1}).bins(), 88u);  // 8.8 / 0.1 is not whole in binary
  EXPECT_EQ((RangeGate{1, 2, 5}).bins(), 1u);
  EXPECT_DOUBLE_EQ((RangeGate{1, 2, 0.25}).centre(3), 1.875);
}

TEST(RangeGate, says_what_is_wrong_with_it) {
  const auto message = [](RangeGate gate) { return error_of([&] { require_valid(gate, "someone"); }); };
  EXPECT_EQ(message({1, 2, 0.1}), "no error");
  EXPECT_THAT(message({0, 2, 0.1}), HasSubstr("someone: gate.min_range = 0 m, must be > 0"));
  EXPECT_THAT(message({5, 2, 0.1}), HasSubstr("gate.max_range = 2 m, must exceed gate.min_range = 5 m"));
  EXPECT_THAT(message({1, 2, 0}), HasSubstr("gate.bin_size = 0 m, must be > 0"));
  EXPECT_THAT(message({1, 2, std::nan("")}), HasSubstr("gate.bin_size"));
  EXPECT_THAT(message({1, 2, 1e-9}), HasSubstr("2^24 bins"));
}
