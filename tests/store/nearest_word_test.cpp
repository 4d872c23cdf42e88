// SPDX-License-Identifier: BSD-3-Clause
#include "store/nearest_word.hpp"

#include "support/test.hpp"

TEST(NearestWord, finds_a_mistyped_one) {
  const std::vector<std::string> known = {"beams", "beam_width_deg", "min_range_m", "max_range_m"};
  EXPECT_EQ(nearest_word("beam_with_deg", known), "beam_width_deg");
  EXPECT_EQ(nearest_word("baems", known), "beams");
  EXPECT_EQ(nearest_word("max_rnage_m", known), "max_range_m");
  EXPECT_EQ(nearest_word("beams", known), "beams");
}

TEST(NearestWord, is_silent_when_nothing_is_near) {
  EXPECT_EQ(nearest_word("colour", {"beams", "min_range_m"}), "");
  EXPECT_EQ(nearest_word("beams", {}), "");
}

// A third of the length, at least two: abcd may differ in 2 places, not in 3; twelve letters in 4, not in 5.
TEST(NearestWord, allows_a_third_of_the_length_and_at_least_two_edits) {
  EXPECT_EQ(nearest_word("abcd", {"abxy"}), "abxy");
  EXPECT_EQ(nearest_word("abcd", {"axyz"}), "");
  EXPECT_EQ(nearest_word("abcdefghijkl", {"abcdefghWXYZ"}), "abcdefghWXYZ");
  EXPECT_EQ(nearest_word("abcdefghijkl", {"abcdefgVWXYZ"}), "");
}

TEST(NearestWord, takes_the_first_of_equals_and_the_nearer_of_two) {
  EXPECT_EQ(nearest_word("cat", {"bat", "hat"}), "bat");
  EXPECT_EQ(nearest_word("coat", {"chat", "coats", "coat"}), "coat");
}
