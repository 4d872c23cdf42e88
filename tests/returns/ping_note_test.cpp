// SPDX-License-Identifier: BSD-3-Clause
// Tests the gathering of the notes of many pings by kind.
#include "returns/ping_note.hpp"

#include "support/test.hpp"

namespace {

const PingNote sparse_at_5{"sparse beams", "63 of 64 beams", 1, 5}, sparse_at_2{"sparse beams", "9 of 64 beams", 1, 2},
    bent_at_3{"refraction", "wrong by 1 m", 4, 3};

std::vector<PingNote> gathered(const std::vector<PingNote>& notes) {
  std::vector<PingNote> all;
  for (const PingNote& note : notes) gather(all, {note});
  return all;
}

}  // namespace

TEST(PingNotes, are_counted_by_kind_with_the_text_of_the_first_ping_in_any_order) {
  const std::vector<PingNote> expected = {{"sparse beams", "9 of 64 beams", 2, 2}, bent_at_3};
  EXPECT_EQ(gathered({sparse_at_5, sparse_at_2, bent_at_3}), expected);
  EXPECT_EQ(gathered({bent_at_3, sparse_at_2, sparse_at_5}), expected);
  EXPECT_EQ(sentence(expected[0]), "2 pings, the first 2: 9 of 64 beams");
  EXPECT_EQ(sentence(sparse_at_5), "1 ping, number 5: 63 of 64 beams");
  EXPECT_EQ(sentence(sparse_at_5, true), "63 of 64 beams");
}

TEST(PingNotes, are_lines_of_text_and_back) {
  const std::vector<PingNote> notes = {sparse_at_2, {"law of a", "two\tcells", 3, -1}};
  EXPECT_EQ(as_lines(notes), "1\t2\tsparse beams\t9 of 64 beams\n3\t-1\tlaw of a\ttwo\tcells\n");
  EXPECT_EQ(notes_in(as_lines(notes)), notes);
  EXPECT_EQ(notes_in("x\t2\tkind\ttext\n\n1\t2\n" + as_lines({bent_at_3})), std::vector{bent_at_3});
  EXPECT_EQ(notes_in(as_lines({{"kind", "two\nlines", 1, 0}})).at(0).text, "two lines");
}
