// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/sampled_cells.hpp"
#include "sampling_scenes.hpp"
#include "support/test.hpp"

using Eigen::Vector3d;

namespace {

const BeamFan split_fan = make_fan(64, radians(60), radians(1), radians(40));
const RangeGate split_gate{0.1, 50, 0.01};
const Vector3d ten_ahead(10, 0, 0);

SceneCloud small_wall() {
  SceneCloud scene;
  add_wall(scene, 5, 1, 1, 0.05, 0.3);
  return scene;
}

double total(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += v;
  return sum;
}

Vector3d world_position(const Scatterers& s, std::size_t i, const Pose& pose) {
  return pose * (s.range[i] * unit_vector({s.azimuth[i], s.elevation[i]}));
}

}  // namespace

TEST(Splitting, puts_the_requested_number_of_parts_in_a_cell) {
  // At 45 degrees, range 10 m: a cell is 0.02 sqrt(2) m by 0.2 m, so 1 m^2 holds 176.8 cells (E17).
  const SampledCells cells(make_fan(1, 0, 0.02, 1), {0.1, 50, 1},
                           {.scatterers_per_cell = 10, .range_resolution = 0.02});
  EXPECT_NEAR(cells.pieces(ten_ahead, 1, std::sqrt(0.5)), 1767.8, 0.1);
  // At normal incidence a plane within dr is 2 sqrt(2 r dr) = 1.2649 m long.
  EXPECT_NEAR(cells.pieces(ten_ahead, 1, 1), 39.53, 0.01);
  EXPECT_EQ(cells.pieces(ten_ahead, 1e-6, 0.5), 1);
  const SampledCells none(make_fan(1, 0, 0.02, 1), {0.1, 50, 0.01}, {.scatterers_per_cell = 0});
  EXPECT_EQ(none.pieces(ten_ahead, 1, 0.5), 1);
  // Without a resolution it is two bins.
  const SampledCells bins(make_fan(1, 0, 0.02, 1), {0.1, 50, 0.01}, {.scatterers_per_cell = 10});
  EXPECT_EQ(bins.pieces(ten_ahead, 1, 0.5), cells.pieces(ten_ahead, 1, 0.5));
}

// A planar array at range 10 m with beams of 0.02 rad both ways: the cross-section of 0.2 x 0.2 m at 45 degrees is
// still longer than the cell; a beam of 0.005 rad in elevation reduces the cell to a quarter.
TEST(Splitting, puts_the_requested_number_of_parts_in_a_cell_of_a_planar_array) {
  const RangeGate gate{0.1, 50, 0.01};
  BeamFan fan = make_fan(1, 0, 0.02, 1);
  fan.row_width = 0.02;
  const SamplingOptions ten{.scatterers_per_cell = 10};
  EXPECT_NEAR(SampledCells(fan, gate, ten).pieces(ten_ahead, 1, std::sqrt(0.5)), 1767.8, 0.1);
  EXPECT_NEAR(SampledCells(fan, gate, ten).pieces(ten_ahead, 0.1, 1), 25, 1e-9);
  fan.row_width = 0.005;
  EXPECT_NEAR(SampledCells(fan, gate, ten).pieces(ten_ahead, 0.25, std::sqrt(0.5)), 1767.8, 0.1);
  // A tenth of a radian beyond the ends of the lobes both ways the cell is 0.05 rad x 0.05 rad.
  const double u = 1.5 * 0.02 + 0.1, v = 1.5 * 0.005 + 0.1;
  const Vector3d beside(10 * std::sqrt(1 - u * u - v * v), 10 * u, 10 * v);
  EXPECT_NEAR(SampledCells(fan, gate, ten).pieces(beside, 1e-3, 1), std::max(1.0, 10 * 1e-3 / (0.5 * 0.5)), 1e-9);
  EXPECT_NEAR(SampledCells(fan, gate, ten).widths(beside, 0).beam, 0.05, 1e-12);
  EXPECT_NEAR(SampledCells(fan, gate, ten).widths(beside, 0).row, 0.05, 1e-12);
}

// Beams of 0.02 rad at u = 0 and 0.5: their main lobes end 0.03 beside them (E17).
TEST(Splitting, takes_cells_half_as_wide_as_they_are_off_the_nearest_main_lobe) {
  BeamFan fan = make_fan(2, 1, 0.02, 1);
  fan.azimuth = {pi / 6, 0};
  const RangeGate gate{0.1, 50, 0.01};
  const SampledCells cells(fan, gate, {});
  const auto at_u = [](double u) { return Vector3d(10 * std::sqrt(1 - u * u), 10 * u, 0); };
  for (const double inside : {0.0, 0.03, -0.03, 0.069, -0.069, 0.47, 0.53, 0.569})
    EXPECT_EQ(cells.widths(at_u(inside), 0).beam, 0.02) << inside;
  EXPECT_NEAR(cells.widths(at_u(0.23), 0).beam, 0.1, 1e-12);
  EXPECT_NEAR(cells.widths(at_u(0.29), 0).beam, 0.09, 1e-12);  // nearer to the other
  EXPECT_NEAR(cells.widths(at_u(-1), 0).beam, 0.485, 1e-12);
  EXPECT_NEAR(cells.widths(at_u(0.73), 0).beam, 0.1, 1e-12);
  // Surfels that reach into a lobe are cut as inside; for others, the nearest part counts.
  EXPECT_EQ(cells.widths(at_u(0.23), 1.7).beam, 0.02);
  EXPECT_NEAR(cells.widths(at_u(0.23), 1).beam, 0.05, 1e-12);
  // The fewer parts of a surfel, the wider its cell: here 0.1 less half of what it reaches towards the lobe.
  EXPECT_NEAR(cells.pieces(at_u(-0.23), 0.01 * pi, 0.5) / cells.pieces(at_u(0), 0.01 * pi, 0.5), 0.02 / 0.095, 1e-6);
  const SampledCells wider(fan, gate, {.lobe_margin = 0.1}), everywhere(fan, gate, {.lobe_margin = 2});
  EXPECT_NEAR(wider.widths(at_u(0.73), 0).beam, 0.05, 1e-12);
  EXPECT_EQ(everywhere.widths(at_u(-1), 0).beam, 0.02);
}

TEST(Splitting, keeps_the_projected_area_and_gives_unique_ids) {
  const SceneCloud scene = small_wall();
  const Scatterers whole = find_scatterers(scene, at(0, 0, 0), split_fan, split_gate, unsplit()).scatterers;
  const Scatterers pieces =
      find_scatterers(scene, at(0, 0, 0), split_fan, split_gate, {.scatterers_per_cell = 200}).scatterers;
  EXPECT_EQ(whole.size(), scene.size());
  EXPECT_GT(pieces.size(), 5 * whole.size());
  EXPECT_NEAR(total(pieces.projected_area), total(whole.projected_area), 1e-4 * total(whole.projected_area));
  EXPECT_EQ(std::set(pieces.id.begin(), pieces.id.end()).size(), pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) ASSERT_EQ(pieces.id[i] >> 32, scene.id[pieces.surfel[i]]);
}

TEST(Splitting, leaves_an_unsplit_surfel_at_its_centre) {
  const SceneCloud scene = small_wall();
  const Pose pose = at(0.5, 0.2, -0.1, 3, -2);
  const Scatterers s = find_scatterers(scene, pose, split_fan, split_gate, unsplit()).scatterers;
  for (std::size_t i = 0; i < s.size(); ++i)
    ASSERT_LT((world_position(s, i, pose) - scene.point[s.surfel[i]].cast<double>()).norm(), 1e-12);
}

TEST(Splitting, puts_every_part_at_the_same_place_for_every_pose) {
  const SceneCloud scene = small_wall();
  const SamplingOptions options{.scatterers_per_cell = 300};
  const Pose poses[] = {at(0, 0, 0), at(-20, 3, 1, -7, 4), at(2, -1, 0.5, 15, 0)};
  std::map<std::uint64_t, Vector3d> positions;
  std::size_t shared = 0;
  std::set<std::size_t> sizes;
  for (const Pose& pose : poses) {
    const Scatterers s = find_scatterers(scene, pose, split_fan, split_gate, options).scatterers;
    sizes.insert(s.size());
    for (std::size_t i = 0; i < s.size(); ++i) {
      const auto [position, is_new] = positions.emplace(s.id[i], world_position(s, i, pose));
      if (is_new) continue;
      ++shared;
      ASSERT_LT((position->second - world_position(s, i, pose)).norm(), 1e-9);
    }
  }
  EXPECT_EQ(sizes.size(), 3u);  // split into different numbers of parts
  EXPECT_GT(shared, 10000u);
}

TEST(Splitting, spreads_parts_evenly_over_the_disc_of_the_surfel) {
  SceneCloud scene;
  add_surfel(scene, {5, 0, 0}, {-1, 0, 0}, pi);  // a disc of radius 1 m
  const Scatterers s =
      find_scatterers(scene, at(0, 0, 0), split_fan, split_gate, {.scatterers_per_cell = 1e4}).scatterers;
  ASSERT_EQ(s.size(), 4096u);
  Vector3d mean = Vector3d::Zero();
  double inner = 0, port = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const Vector3d p = world_position(s, i, Pose::Identity()) - Vector3d(5, 0, 0);
    ASSERT_NEAR(p.x(), 0, 1e-9);
    ASSERT_LE(p.norm(), 1 + 1e-9);
    mean += p / 4096;
    inner += p.norm() < std::sqrt(0.5);
    port += p.y() > 0;
  }
  EXPECT_LT(mean.norm(), 0.005);
  EXPECT_NEAR(inner, 2048, 20);  // half the area
  EXPECT_NEAR(port, 2048, 20);
}

TEST(Splitting, follows_the_seed) {
  const SceneCloud scene = small_wall();
  SamplingOptions options{.scatterers_per_cell = 100};
  const auto range = find_scatterers(scene, at(0, 0, 0), split_fan, split_gate, options).scatterers.range;
  options.seed = 2;
  EXPECT_NE(find_scatterers(scene, at(0, 0, 0), split_fan, split_gate, options).scatterers.range, range);
}
