// SPDX-License-Identifier: BSD-3-Clause
#include "support/test.hpp"
#include "view/axes_internal.hpp"
#include "view/drawn_cells_internal.hpp"
#include "view/test_pictures.hpp"

namespace {

// Returns an image whose beam b, in the order given, has the level b everywhere.
LevelImage image_at(const std::vector<double>& azimuth_deg, std::size_t bins = 3) {
  LevelImage image = flat_image(azimuth_deg.size(), 90, bins, 0);
  for (std::size_t b = 0; b < azimuth_deg.size(); ++b) {
    image.fan.azimuth[b] = radians(azimuth_deg[b]);
    image.level_db.row(static_cast<Eigen::Index>(b)) = static_cast<float>(b);
  }
  return image;
}

std::vector<double> edges_deg(const BeamCells& cells) {
  std::vector<double> edges;
  for (const double edge : cells.edges) edges.push_back(degrees(edge));
  return edges;
}

std::vector<float> first_levels(const BeamCells& cells) {
  return {cells.level_db.col(0).begin(), cells.level_db.col(0).end()};
}

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Pointwise;

}  // namespace

TEST(BeamCells, port_beams_have_negative_bearings_and_edges_lie_halfway) {
  const BeamCells cells = order_beams(image_at({-20, 0, 10}));
  EXPECT_THAT(edges_deg(cells), Pointwise(DoubleNear(1e-9), {-15.0, -5.0, 10.0, 30.0}));
  EXPECT_THAT(first_levels(cells), ElementsAre(2, 1, 0));
}

TEST(BeamCells, do_not_depend_on_the_order_of_the_beams) {
  std::vector<double> azimuth_deg = {-50, -31, -30, -12, 1, 2, 17, 44};
  const auto edges = edges_deg(order_beams(image_at(azimuth_deg)));
  std::mt19937 shuffle(3);
  for (int turn = 0; turn < 20; ++turn) {
    std::shuffle(azimuth_deg.begin(), azimuth_deg.end(), shuffle);
    const BeamCells cells = order_beams(image_at(azimuth_deg));
    EXPECT_THAT(edges_deg(cells), Pointwise(DoubleNear(1e-9), edges));
    for (std::size_t c = 0; c + 1 < cells.edges.size(); ++c) {
      const auto beam = static_cast<std::size_t>(cells.level_db(static_cast<Eigen::Index>(c), 0));
      EXPECT_GT(-azimuth_deg[beam], edges[c]);
      EXPECT_LT(-azimuth_deg[beam], edges[c + 1]);
    }
  }
}

TEST(BeamCells, a_fan_across_the_stern_is_one_piece) {
  const BeamCells cells = order_beams(image_at({160, 170, 180, -170, -160}));
  EXPECT_NEAR(degrees(cells.high() - cells.low()), 50, 1e-9);
  EXPECT_THAT(first_levels(cells), ElementsAre(4, 3, 2, 1, 0));
}

TEST(BeamCells, a_full_scan_closes_without_gap_or_overlap) {
  std::vector<double> azimuth_deg;
  for (int b = 0; b < 400; ++b) azimuth_deg.push_back(std::remainder(0.9 * b, 360.0));
  const BeamCells cells = order_beams(image_at(azimuth_deg));
  EXPECT_EQ(cells.level_db.rows(), 400);
  EXPECT_NEAR(cells.high() - cells.low(), 2 * pi, 1e-9);
  EXPECT_TRUE(std::is_sorted(cells.edges.begin(), cells.edges.end()));
}

TEST(BeamCells, a_lone_beam_is_as_wide_as_its_beam_width) {
  LevelImage image = image_at({25});
  image.fan.beam_width = radians(3);
  EXPECT_THAT(edges_deg(order_beams(image)), Pointwise(DoubleNear(1e-9), {-26.5, -23.5}));
}

TEST(BeamCells, beams_of_one_azimuth_share_a_cell_that_shows_the_strongest) {
  LevelImage image = image_at({-10, 5, 5});
  image.fan.elevation = {0, 0, 0.1};
  image.level_db.row(1) << 0, 10, -200;
  image.level_db.row(2) << 10, 0, -100;
  const BeamCells cells = order_beams(image);
  ASSERT_EQ(cells.level_db.rows(), 2);
  EXPECT_THAT(std::vector<float>(cells.level_db.row(0).begin(), cells.level_db.row(0).end()),
              ElementsAre(10, 10, -100));
  EXPECT_EQ(unit_text("dB", cells), "dB, strongest of 2 elevations");
  EXPECT_EQ(unit_text("dB", order_beams(image_at({-10, 5}))), "dB");
}

// Rows offset by half a spacing, beams 2 degrees wide: one cell for two beams, not stripes of either row.
TEST(BeamCells, of_staggered_rows_take_in_half_a_beam_width) {
  LevelImage image = image_at({-4, -3.5, -2, -1.5, 0, 0.5});
  image.fan.beam_width = radians(2);
  for (std::size_t b = 1; b < 6; b += 2) image.fan.elevation[b] = 0.1;
  const BeamCells cells = order_beams(image);
  EXPECT_THAT(first_levels(cells), ElementsAre(5, 3, 1));
  EXPECT_THAT(edges_deg(cells), Pointwise(DoubleNear(1e-9), {-1.25, 0.75, 2.75, 4.75}));
}

TEST(FanPatches, of_cells_larger_than_pixels_hold_them_unchanged) {
  LevelImage image = flat_image(40, 60, 30, 0);
  for (Eigen::Index i = 0; i < image.level_db.size(); ++i) image.level_db.data()[i] = static_cast<float>(i % 97);
  const BeamCells cells = order_beams(image);
  const std::vector<CellPatch> patches = fan_patches(cells, image.gate, 100);
  ASSERT_EQ(patches.size(), 1u);
  EXPECT_EQ(patches[0].beams_per_row, 1u);
  EXPECT_TRUE((patches[0].level_db == cells.level_db).all());
}

TEST(FanPatches, cover_the_gate_without_gaps_and_keep_the_energy) {
  LevelImage image = flat_image(512, 60, 4001, 0);
  std::mt19937 seed(11);
  std::normal_distribution<float> level(100, 6);
  for (float& db : image.level_db.reshaped()) db = level(seed);
  const BeamCells cells = order_beams(image);
  const std::vector<CellPatch> patches = fan_patches(cells, image.gate, 0.4);  // 5 bins per pixel, 800 pixels of radius

  double outer = image.gate.min_range + 4001 * image.gate.bin_size, energy = 0;
  for (const CellPatch& patch : patches) {
    EXPECT_DOUBLE_EQ(patch.max_range, outer);
    outer = patch.min_range;
    const double bins = std::round((patch.max_range - patch.min_range) / image.gate.bin_size);
    const double group = std::round(bins / patch.columns);
    EXPECT_GE(group * image.gate.bin_size * 0.4, 0.5) << "bins per pixel";
    for (Eigen::Index row = 0; row < patch.level_db.rows(); ++row)
      for (Eigen::Index column = 0; column < patch.level_db.cols(); ++column) {
        const double beams =
            std::min<double>(static_cast<double>(patch.beams_per_row),
                             512.0 - static_cast<double>(patch.beams_per_row) * static_cast<double>(row));
        const double filled = std::min(group, bins - group * static_cast<double>(column));
        energy += beams * filled * power_from_db(patch.level_db(row, column));
      }
  }
  EXPECT_DOUBLE_EQ(outer, image.gate.min_range);
  EXPECT_GT(patches.size(), 2u) << "beams narrow towards the apex";
  const double whole = cells.level_db.cast<double>().unaryExpr([](double db) { return power_from_db(db); }).sum();
  EXPECT_NEAR(energy / whole, 1, 1e-6);
}

// 100 beams on 80 pixels and 203 bins on 60: groups of one beam and of two bins, of which the last has one alone.
TEST(RectPatch, combines_cells_below_half_a_pixel_and_keeps_the_energy) {
  LevelImage image = flat_image(100, 60, 203, 0);
  std::mt19937 seed(5);
  std::normal_distribution<float> level(100, 6);
  for (float& db : image.level_db.reshaped()) db = level(seed);
  const BeamCells cells = order_beams(image);
  const CellPatch patch = rect_patch(cells, image.gate, 80, 60);
  EXPECT_EQ(patch.beams_per_row, 1u);
  ASSERT_EQ(patch.level_db.rows(), 100);
  ASSERT_EQ(patch.level_db.cols(), 102);
  EXPECT_DOUBLE_EQ(patch.columns, 101.5);
  const auto power = [&](Eigen::Index bin) { return power_from_db(static_cast<double>(cells.level_db(7, bin))); };
  EXPECT_NEAR(patch.level_db(7, 3), db_from_power((power(6) + power(7)) / 2), 1e-4);
  EXPECT_NEAR(patch.level_db(7, 101), cells.level_db(7, 202), 1e-4);
  // Three beams share a row of 20 pixels for 100.
  const CellPatch narrow = rect_patch(cells, image.gate, 20, 1000);
  EXPECT_EQ(narrow.beams_per_row, 3u);
  EXPECT_EQ(narrow.level_db.rows(), 34);
  EXPECT_EQ(narrow.level_db.cols(), 203);
}

TEST(RequireDrawable, levels_of_another_size_than_beams_and_bins_are_an_error) {
  LevelImage image = flat_image(4, 60, 10, 0);
  image.level_db.resize(5, 10);
  EXPECT_EQ(error_of([&] { require_drawable(image, {}, "show_fan"); }),
            "show_fan: image.level_db is 5 x 10, must be beams x bins = 4 x 10");
}

TEST(RequireDrawable, a_picture_too_small_for_labels_is_an_error) {
  PictureOptions options;
  options.height = 100;
  EXPECT_THROW(require_drawable(flat_image(4, 60, 10, 0), options, "show_fan"), Error);
}

TEST(Ticks, bearings_carry_their_sign_and_wrap_at_the_stern) {
  EXPECT_EQ(bearing_text(-60, 20), "-60°");
  EXPECT_EQ(bearing_text(-1e-12, 20), "0°");
  EXPECT_EQ(bearing_text(60, 20), "+60°");
  EXPECT_EQ(bearing_text(190, 10), "-170°");
  EXPECT_EQ(bearing_text(-180, 10), "180°");
  EXPECT_EQ(bearing_text(2.5, 0.5), "+2.5°");
}

TEST(Ticks, are_round_and_few) {
  EXPECT_EQ(round_step(0.012), 0.02);
  EXPECT_EQ(round_step(3.75), 5);
  EXPECT_EQ(round_step(5), 5);
  EXPECT_THAT(bearing_ticks(-65, 65, 8).at_deg, ElementsAre(-60, -40, -20, 0, 20, 40, 60));
  EXPECT_THAT(bearing_ticks(33.2, 34.2, 8).at_deg.size(), testing::Le(8u));
  EXPECT_EQ(bearing_ticks(33.2, 33.21, 0.5).at_deg.size(), 1u) << "a thin beam still has its bearing";
}
