// SPDX-License-Identifier: BSD-3-Clause
// Tests objects that are kept by key: made once, side by side, and dropped in the order of their use.
#include <latch>
#include <thread>

#include "simulate/last_made_internal.hpp"
#include "support/test.hpp"

TEST(LastMade, makes_one_object_a_key_and_keeps_the_last_used) {
  LastMade<int, int> kept(2);
  int made = 0;
  const auto of = [&](int key) { return *kept.of(key, [&] { return ++made, 10 * key; }); };
  EXPECT_EQ(of(1), 10);
  EXPECT_EQ(of(2), 20);
  EXPECT_EQ(of(1), 10);
  EXPECT_EQ(made, 2);
  of(3);  // drops 2
  of(1);
  EXPECT_EQ(made, 3);
  of(2);
  EXPECT_EQ(made, 4);
}

// Two threads each make an object that is ready only when the other is being made, too: under one lock neither ends.
TEST(LastMade, makes_objects_of_other_keys_side_by_side) {
  LastMade<int, int> kept(4);
  std::latch both(2);
  const auto make = [&](int key) { kept.of(key, [&] { return both.arrive_and_wait(), key; }); };
  std::thread one(make, 1), other(make, 2);
  one.join(), other.join();
  EXPECT_EQ(*kept.of(1, [] { return 0; }), 1);
  EXPECT_EQ(*kept.of(2, [] { return 0; }), 2);
}

TEST(LastMade, tries_again_after_an_error) {
  LastMade<int, int> kept(2);
  EXPECT_EQ(error_of([&] { kept.of(1, []() -> int { fail(ErrorKind::argument, "not now"); }); }), "not now");
  EXPECT_EQ(*kept.of(1, [] { return 7; }), 7);
}
