// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/range_gaps.hpp"

#include "sampling_scenes.hpp"
#include "support/test.hpp"

namespace {

/// Returns hits along the x axis of a plane below, at these ranges; rays in this order.
std::vector<SurfaceHit> on_a_plane(const std::vector<double>& ranges) {
  std::vector<SurfaceHit> hits;
  for (const double r : ranges)
    hits.push_back({static_cast<std::uint32_t>(hits.size()), r, {static_cast<float>(r), 0, -1}, {0, 0, -1}, 0.01F});
  return hits;
}

struct Cast {
  Sampling sampling;
  RangeGaps gaps;
};

Cast cast(const SceneCloud& scene, const Pose& pose, const BeamFan& fan, const RangeGate& gate, int rays,
          int threads = 0) {
  SamplingOptions options;
  options.kind = SamplingKind::rays;
  options.rays_per_beam = rays;
  options.threads = threads;
  const Sampling sampling = find_scatterers(scene, pose, fan, gate, options);
  return {sampling, count_range_gaps(scene, pose, sampling.scatterers, rays, 2 * gate.bin_size)};
}

}  // namespace

TEST(RangeGaps, counts_empty_cells_between_the_first_hit_and_the_last) {
  const RangeGaps g = count_range_gaps(on_a_plane({1.05, 1.15, 1.45, 2.05}), 0.1);  // cells 10, 11, 14 and 20
  EXPECT_EQ(g.cells, 11u);
  EXPECT_EQ(g.empty, 7u);
  EXPECT_NEAR(g.widest, 0.5, 1e-12);
}

TEST(RangeGaps, do_not_depend_on_the_sense_of_the_rays_and_fill_up_with_later_ones) {
  const RangeGaps up = count_range_gaps(on_a_plane({1.05, 1.35, 2.05}), 0.1);
  const RangeGaps down = count_range_gaps(on_a_plane({2.05, 1.35, 1.05}), 0.1);
  EXPECT_EQ(up.cells, down.cells);
  EXPECT_EQ(up.empty, 8u);
  EXPECT_EQ(down.empty, 8u);
  // Two interleaved sequences of hits, half a gap apart: each fills the gaps of the other.
  EXPECT_EQ(count_range_gaps(on_a_plane({1.05, 1.25, 1.45, 1.35, 1.15}), 0.1).empty, 0u);
}

TEST(RangeGaps, are_none_where_a_ray_between_met_nothing) {
  std::vector<SurfaceHit> hits = on_a_plane({1.05, 2.05});
  hits[1].ray = 2;
  EXPECT_EQ(count_range_gaps(hits, 0.1).cells, 0u);
  EXPECT_EQ(count_range_gaps({}, 0.1).cells, 0u);
}

TEST(RangeGaps, are_none_between_two_surfaces) {
  const auto one = [](const SurfaceHit& b) { return on_one_surface({0, 1, {1, 0, -1}, {0, 0, -1}, 0.01F}, b); };
  EXPECT_TRUE(one({1, 3, {3, 0, -1}, {0, 0, -1}, 0.01F}));
  EXPECT_TRUE(one({1, 3, {3, 0, -1.09F}, {0, 0, -1}, 0.01F}));   // a slope of 4.5 %
  EXPECT_FALSE(one({1, 3, {3, 0, -1.5F}, {0, 0, -1}, 0.01F}));   // a step down, seen past its edge
  EXPECT_FALSE(one({1, 1.5, {1.5F, 0, -1}, {1, 0, 0}, 0.01F}));  // floor and wall
  const float s = std::sin(0.5F), c = std::cos(0.5F);            // an arc of radius 2 from bottom to side
  EXPECT_TRUE(one({1, 2, {1 + 2 * s, 0, 1 - 2 * c}, {s, 0, -c}, 0.01F}));
}

// Flat bottom 3 m below at 30 m: 21 rays over 20 degrees lie 17 mrad apart and leave r^2 dphi / h = 5 m between hits.
TEST(RangeGaps, of_21_rays_at_30_m_over_a_bottom_3_m_below_are_about_5_m_wide) {
  SceneCloud scene;
  add_rectangle(scene, {5, -2, 0}, {35, 0, 0}, {0, 4, 0}, {0, 0, 1}, 0.05);
  const BeamFan fan = make_fan(5, radians(2.5), radians(0.5), radians(10), radians(-5.5));
  const RangeGate gate{10, 32, 0.0127};  // cells of 2.54 cm
  const RangeGaps few = cast(scene, at(0, 0, 3), fan, gate, 21).gaps;
  EXPECT_GT(static_cast<double>(few.empty), 0.95 * static_cast<double>(few.cells));
  EXPECT_GT(few.widest, 3);
  EXPECT_LT(few.widest, 10);  // jitter: up to two steps
  const auto notes = range_gap_notes(few, 21, 0.0254);
  ASSERT_EQ(notes.size(), 1u);
  for (const char* part : {"rays are too few", "m in a row", "sample surfels", "rays per beam"})
    EXPECT_THAT(notes[0], HasSubstr(part)) << notes[0];

  // Four rays to each cell where they lie farthest apart: no note.
  const RangeGaps many = cast(scene, at(0, 0, 3), fan, gate, 16400).gaps;
  EXPECT_LT(static_cast<double>(many.empty), 0.01 * static_cast<double>(many.cells));
  EXPECT_TRUE(range_gap_notes(many, 16400, 0.0254).empty());
}

TEST(RangeGaps, of_a_wall_head_on_and_of_two_walls_are_none) {
  SceneCloud scene;
  add_rectangle(scene, {5, -2, -2}, {0, 2, 0}, {0, 0, 4}, {-1, 0, 0}, 0.05);
  add_rectangle(scene, {9, 0, -2}, {0, 2, 0}, {0, 0, 4}, {-1, 0, 0}, 0.05);
  const Cast c = cast(scene, at(0, 0, 0), make_fan(16, radians(20), radians(1), radians(4)), {1, 12, 0.05}, 32);
  EXPECT_GT(c.sampling.scatterers.size(), 400u);
  EXPECT_EQ(c.gaps.empty, 0u);
}

// Head and scene moved and rotated together, several numbers of threads, and no scatterers.
TEST(RangeGaps, do_not_depend_on_threads_or_on_the_world_origin) {
  SceneCloud scene, moved;
  add_rectangle(scene, {2, -4, 0}, {20, 0, 0}, {0, 8, 0}, {0, 0, 1}, 0.1);
  add_rectangle(moved, {-96, -4, 7}, {20, 0, 0}, {0, 8, 0}, {0, 0, 1}, 0.1);
  const BeamFan fan = make_fan(16, radians(20), radians(1), radians(10), radians(-8));
  const RangeGate gate{1, 20, 0.02};
  const RangeGaps one = cast(scene, at(0, 0, 2), fan, gate, 32, 1).gaps;
  EXPECT_GT(one.empty, 0u);
  for (const int threads : {2, 7}) {
    const RangeGaps many = cast(scene, at(0, 0, 2), fan, gate, 32, threads).gaps;
    EXPECT_EQ(many.cells, one.cells);
    EXPECT_EQ(many.empty, one.empty);
    EXPECT_EQ(many.widest, one.widest);
  }
  const RangeGaps there = cast(moved, at(-98, 0, 9), fan, gate, 32).gaps;
  EXPECT_NEAR(static_cast<double>(there.empty), static_cast<double>(one.empty), 0.01 * static_cast<double>(one.empty));
  EXPECT_EQ(count_range_gaps(scene, at(0, 0, 2), {}, 32, 0.04).cells, 0u);
}

TEST(RangeGaps, refuse_no_rays_and_cells_without_length) {
  EXPECT_EQ(error_of([] { count_range_gaps({}, Pose::Identity(), {}, 0, 0.1); }),
            "count_range_gaps: rays_per_beam = 0, must be at least 1");
  EXPECT_EQ(error_of([] { count_range_gaps({}, Pose::Identity(), {}, 1, 0); }),
            "count_range_gaps: cell = 0 m, must be finite and > 0");
}
