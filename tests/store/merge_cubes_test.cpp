// SPDX-License-Identifier: BSD-3-Clause
#include "store/merge_cubes_by_time.hpp"
#include "support/test.hpp"

using testing::ElementsAre;

namespace {

// Returns a cube of one ping whose samples are all `value`, which identifies it.
NamedCube run_of(const std::string& name, double time, float value, std::int64_t number = 0) {
  Ping ping;
  ping.number = number;
  ping.time = time;
  ping.fan = make_fan(4, radians(40), radians(1), radians(20));
  ping.gate = {1, 2, 0.1};
  ping.pressure = ComplexGridF::Constant(4, 10, value);
  ping.layers = {{"direct", ping.pressure}, {"noise", ping.pressure}};
  Cube cube;
  cube.pings = {ping};
  cube.sonar = "test";
  cube.sound_speed = 1500;
  cube.centre_frequency = 900e3, cube.bandwidth = 30e3;
  cube.seed = static_cast<std::uint64_t>(value);
  return {name, cube};
}

std::vector<float> values(const Cube& cube) {
  std::vector<float> first;
  for (const Ping& ping : cube.pings) first.push_back(ping.pressure(0, 0).real());
  return first;
}

std::vector<std::int64_t> numbers(const Cube& cube) {
  std::vector<std::int64_t> all;
  for (const Ping& ping : cube.pings) all.push_back(ping.number);
  return all;
}

template <typename Change>
std::string refusal_of_merging(Change&& change) {
  NamedCube second = run_of("out-1", 1, 2);
  change(second.cube);
  return error_with_kind([&] { merge_cubes_by_time({run_of("out-0", 0, 1), second}); });
}

}  // namespace

TEST(MergeCubes, puts_pings_in_order_of_time_and_says_of_the_rest_what_the_first_cube_does) {
  const MergedCube traced = merge_cubes_by_time({run_of("b", 2, 20, 7), run_of("a", 1, 10, 9), run_of("c", 3, 30, 8)});
  const Cube& merged = traced.cube;
  ASSERT_EQ(traced.origins.size(), 3u);
  EXPECT_EQ(traced.origins[0].cube, 1u);
  EXPECT_EQ(traced.origins[0].number, 9);
  EXPECT_EQ(traced.origins[2].cube, 2u);
  EXPECT_THAT(values(merged), ElementsAre(10, 20, 30));
  EXPECT_THAT(numbers(merged), ElementsAre(9, 7, 8)) << "unique numbers stay";
  EXPECT_EQ(merged.seed, 20U);
  EXPECT_EQ(merged.pings[2].layers.size(), 2U);
}

TEST(MergeCubes, keeps_the_order_given_for_pings_of_one_time_and_counts_numbers_that_are_alike) {
  const Cube merged = merge_cubes_by_time({run_of("b", 5, 20, 3), run_of("a", 5, 10, 3), run_of("c", 0, 30, 3)}).cube;
  EXPECT_THAT(values(merged), ElementsAre(30, 20, 10));
  EXPECT_THAT(numbers(merged), ElementsAre(0, 1, 2));
}

TEST(MergeCubes, gathers_notes_under_the_numbers_of_the_merged_pings) {
  NamedCube late = run_of("late", 5, 20, 3), early = run_of("early", 1, 10, 3);
  late.cube.notes = {{"silent", "late", 1, 3}}, early.cube.notes = {{"silent", "early", 1, 3}, {"backs", "all", 1, 3}};
  const std::vector<PingNote> expected = {{"backs", "all", 1, 0}, {"silent", "early", 2, 0}};
  EXPECT_EQ(merge_cubes_by_time({late, early}).cube.notes, expected);
}

TEST(MergeCubes, keeps_layers_only_if_all_pings_have_the_same) {
  NamedCube second = run_of("b", 1, 2);
  second.cube.pings[0].layers.pop_back();
  for (const Ping& ping : merge_cubes_by_time({run_of("a", 0, 1), second}).cube.pings) EXPECT_TRUE(ping.layers.empty());
}

TEST(MergeCubes, makes_a_cube_that_can_be_written_and_read) {
  const Cube merged = merge_cubes_by_time({run_of("a", 0, 1), run_of("b", 1, 2)}).cube;
  write_cube(own_path("all.h5"), merged);
  EXPECT_THAT(values(read_cube(own_path("all.h5"))), ElementsAre(1, 2));
}

TEST(MergeCubes, leaves_each_ping_in_its_own_water) {
  NamedCube cold = run_of("cold", 1, 2), other = run_of("other", 0, 1);
  cold.cube.sound_speed = 1480, cold.cube.absorption_db_per_m = 0.1;
  other.cube.pings[0].sound_speed = 1510, other.cube.pings[0].absorption_db_per_m = 0.2;
  const Cube merged = merge_cubes_by_time({cold, other}).cube;
  EXPECT_EQ(merged.pings[0].sound_speed, 1510);
  EXPECT_EQ(merged.pings[1].sound_speed, 1480);
  write_cube(own_path("all.h5"), merged);
  const Cube back = read_cube(own_path("all.h5"));
  EXPECT_EQ(back.sound_speed, 1480) << "of the first that was given";
  EXPECT_EQ(back.pings[0].sound_speed, 1510);
  EXPECT_EQ(back.pings[0].absorption_db_per_m, 0.2);
  EXPECT_EQ(back.pings[1].absorption_db_per_m, 0.1);
}

TEST(MergeCubes, refuses_another_sonar_fan_gate_or_pulse) {
  EXPECT_EQ(
      refusal_of_merging([](Cube& c) { c.sonar = "other"; }),
      "content: out-1: is of sonar other, not test as in out-0; only pings of one sonar, fan and gate can be merged");
  EXPECT_THAT(refusal_of_merging([](Cube& c) { c.pings[0].fan = make_fan(5, 1, 0.1, 0.1); }),
              HasSubstr("out-1: has 5 beams, not 4 as in out-0"));
  EXPECT_THAT(refusal_of_merging([](Cube& c) { c.pings[0].fan.azimuth[2] += 1e-6; }),
              HasSubstr("beams of other directions"));
  EXPECT_THAT(refusal_of_merging([](Cube& c) { c.pings[0].gate.max_range = 2.1; }),
              HasSubstr("has ranges 1 to 2.1 m in bins of 0.1 m, not 1 to 2 m in bins of 0.1 m"));
  EXPECT_THAT(refusal_of_merging([](Cube& c) { c.bandwidth = 20e3; }),
              HasSubstr("has a pulse of 900000 Hz and 20000 Hz wide"));
  EXPECT_THAT(refusal_of_merging([](Cube& c) { c.pings.clear(); }), HasSubstr("content: out-1: holds no pings"));
  EXPECT_THAT(error_with_kind([] { merge_cubes_by_time({}); }), HasSubstr("argument: merge_cubes_by_time: no cubes"));
}
