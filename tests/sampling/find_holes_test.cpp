// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/find_holes.hpp"

#include "sampling_scenes.hpp"
#include "support/test.hpp"

namespace {

constexpr double wall = 5, spacing = 0.05;

/// Adds a wall at `x` without the surfels nearer than `radius` to the point at `y`, z = 0.
void add_pierced_wall(SceneCloud& scene, double x, double y, double radius) {
  SceneCloud whole;
  add_wall(whole, x, 3, 1.5, spacing);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const Eigen::Vector3d p = whole.point[i].cast<double>();
    if (std::hypot(p.y() - y, p.z()) >= radius) add_surfel(scene, p, {-1, 0, 0}, whole.area[i]);
  }
}

const BeamFan holes_fan = make_fan(60, radians(60), radians(1), radians(20));
const RangeGate holes_gate = {1, 12, 0.05};
const SamplingOptions dense{.rays_per_beam = 200};

Holes holes_in(const SceneCloud& scene, const SamplingOptions& options = dense) {
  return find_holes(PreparedScene(scene), Pose::Identity(), holes_fan, holes_gate, options);
}

}  // namespace

TEST(FindHoles, marks_the_bearing_and_range_of_a_small_hole_and_nothing_else) {
  SceneCloud scene;
  const double y = 0.7, radius = 2.5 * spacing;
  add_pierced_wall(scene, wall, y, radius);
  const Grid<std::uint8_t> mask = mask_holes(holes_in(scene), holes_fan, holes_gate);
  ASSERT_EQ(mask.rows(), 60);
  ASSERT_EQ(mask.cols(), 220);
  EXPECT_GT(mask.cast<int>().sum(), 0);
  const double bearing = std::atan2(y, wall), range = std::hypot(y, wall);
  for (Eigen::Index b = 0; b < mask.rows(); ++b)
    for (Eigen::Index n = 0; n < mask.cols(); ++n) {
      if (!mask(b, n)) continue;
      EXPECT_LT(std::abs(holes_fan.azimuth[static_cast<std::size_t>(b)] - bearing), radians(0.5) + radius / wall);
      EXPECT_LT(std::abs(holes_gate.centre(static_cast<std::size_t>(n)) - range), 3.6 * spacing);
    }
  const auto beam = static_cast<Eigen::Index>(std::round((bearing + radians(29.5)) / radians(1)));
  EXPECT_EQ(mask(beam, static_cast<Eigen::Index>((range - holes_gate.min_range) / holes_gate.bin_size)), 1);
}

TEST(FindHoles, is_unaffected_by_a_surface_behind_the_hole) {
  SceneCloud scene;
  add_pierced_wall(scene, wall, 0, 2.5 * spacing);
  const std::size_t alone = holes_in(scene).holes.size();
  add_wall(scene, 8, 5, 3, spacing);
  const Holes holes = holes_in(scene);
  EXPECT_GE(holes.holes.size(), alone);  // rays at the rim hit the surface behind
  for (const Hole& hole : holes.holes) {
    EXPECT_LT(std::hypot(hole.azimuth, hole.elevation), 2.5 * spacing / wall);
    EXPECT_NEAR(hole.max_range, wall, 0.1);
  }
}

TEST(FindHoles, takes_a_wide_opening_for_open_water) {
  SceneCloud scene;
  add_pierced_wall(scene, wall, 0.7, 10 * spacing);
  EXPECT_EQ(holes_in(scene).holes.size(), 0u);
}

TEST(FindHoles, finds_none_in_or_around_a_dense_plane_or_in_empty_water) {
  SceneCloud scene;
  EXPECT_EQ(holes_in(scene).holes.size(), 0u);
  EXPECT_EQ(holes_in(scene).directions, 60u * 200u);
  add_wall(scene, wall, 1, 0.5, spacing, 0.2);
  EXPECT_EQ(holes_in(scene).holes.size(), 0u);
  EXPECT_EQ(find_holes(PreparedScene(scene), at(9, 0, 0, 180), holes_fan, holes_gate, dense).holes.size(),
            0u);  // from behind
  SceneCloud bottom;
  add_rectangle(bottom, {0.5, -6, -2}, {10, 0, 0}, {0, 12, 0}, {0, 0, 1}, spacing, 0.2);
  EXPECT_EQ(holes_in(bottom).holes.size(), 0u);
}

TEST(FindHoles, of_a_sparse_wall_equal_the_unknown_rays_of_find_scatterers) {
  SceneCloud scene;
  add_wall(scene, wall, 4, 3, 0.1);
  for (float& area : scene.area) area *= 0.25f;  // footprints of half the size leave gaps between them
  const SamplingOptions rays{.kind = SamplingKind::rays, .rays_per_beam = 100};
  const SamplingReport report = find_scatterers(scene, Pose::Identity(), holes_fan, holes_gate, rays).report;
  const Holes holes = holes_in(scene, rays);
  EXPECT_GT(report.rays_unknown, 100u);
  EXPECT_EQ(holes.holes.size(), report.rays_unknown);
}

TEST(FindHoles, do_not_depend_on_the_number_of_threads) {
  SceneCloud scene;
  add_pierced_wall(scene, wall, 0.7, 2.5 * spacing);
  const auto mask = [&](int threads) {
    SamplingOptions options = dense;
    options.threads = threads;
    return mask_holes(holes_in(scene, options), holes_fan, holes_gate);
  };
  const Grid<std::uint8_t> one = mask(1);
  for (const int threads : {2, 7}) EXPECT_TRUE((mask(threads) == one).all());
}

TEST(FindHoles, refuses_bad_options) {
  const SceneCloud scene;
  EXPECT_EQ(error_of([&] { holes_in(scene, {.rays_per_beam = 0}); }),
            "find_holes: options.rays_per_beam = 0, must be at least 1");
  EXPECT_EQ(error_of([&] {
              mask_holes({{{60, 0, 0, 2, 3}}, 1}, holes_fan, holes_gate);
            }),
            "mask_holes: beam = 60, but there are 60 beams");
}
