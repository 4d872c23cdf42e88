// SPDX-License-Identifier: BSD-3-Clause
// Two images and the floor that two seeds reach (E124).
#include "compare/image_comparison.hpp"

#include "compare/made_images.hpp"
#include "support/test.hpp"

namespace {

ComparedImage speckled(std::uint64_t seed, int looks = 1) {
  return {with_speckle(smooth_scene(160, 400), seed, looks), make_fan(160, 1, 0.01, 0.2), RangeGate{1, 9, 0.02}};
}
constexpr GreyWindow sixty_db{-10, 50};

}  // namespace

TEST(ImageComparison, of_two_seeds_is_their_floor) {
  const ImageComparison c = compare_level_images(speckled(1), speckled(2), {sixty_db});
  const ImageSimilarity& found = c.similarity.front().similarity;
  EXPECT_NEAR(c.bias_db, 0, 0.06);
  EXPECT_NEAR(c.deviation_db, 7.877, 0.08);  // sqrt(2) 5.57
  EXPECT_NEAR(found.psnr_db, c.floor.drawn.psnr_db, 0.15);
  EXPECT_NEAR(found.psnr_db, c.floor.analytic.psnr_db, 0.2);
  EXPECT_NEAR(c.floor.analytic.psnr_db, 20 * std::log10(60 / 7.877), 0.01);
  EXPECT_NEAR(found.ssim, c.floor.drawn.ssim, 0.05);  // the draws share what speckle the average leaves
  EXPECT_NEAR(found.ssim, c.floor.analytic.ssim, 0.02);
  EXPECT_LT(c.wasserstein_db, 0.15);
  EXPECT_GT(c.samples.probability, 0.01);
  EXPECT_NEAR(c.map_slope, 1, 0.02);
  EXPECT_EQ(c.shift.bins, 0);
  EXPECT_EQ(c.shift.beams, 0);
}

// A scene of steps and a dark, silent part, by speckle as wide as that of a head whose beams overlap: what two seeds
// reach is printed as their floor, from one of them alone.
TEST(ImageComparison, floor_keeps_edges_and_silence) {
  Grid<float> scene(120, 360);
  for (Eigen::Index i = 0; i < 120; ++i)
    for (Eigen::Index n = 0; n < 360; ++n)
      scene(i, n) =
          n < 70 ? -200.0F
                 : static_cast<float>(40 - 0.03 * static_cast<double>(n) - ((n / 45 + i / 20) % 2 == 0 ? 0 : 18));
  const auto seen = [&](std::uint64_t seed) {
    ComparedImage image{Grid<float>(120, 360)};
    for (Eigen::Index i = 0; i < 120; ++i)
      for (Eigen::Index n = 0; n < 360; ++n) {
        // Means of 6 beams x 2 bins of complex noise.
        std::complex<double> sum = 0;
        for (Eigen::Index k = 0; k < 12; ++k)
          sum += random_complex_normal(seed, RandomStage::scene_points,
                                       {static_cast<std::uint64_t>((i + k % 6) * 400 + n + k / 6), 0, 0});
        image.level_db(i, n) = scene(i, n) + (n < 70 ? 0 : static_cast<float>(db_from_power(std::norm(sum) / 12)));
      }
    return image;
  };
  const ImageComparison c = compare_level_images(seen(1), seen(2), {sixty_db});
  const ImageSimilarity& found = c.similarity.front().similarity;
  EXPECT_GT(found.ssim, 0.3);
  EXPECT_NEAR(c.floor.drawn.psnr_db, found.psnr_db, 0.5);
  EXPECT_NEAR(c.floor.drawn.ssim, found.ssim, 0.05);
}

TEST(ImageComparison, floor_of_correlated_speckle_is_that_of_white_speckle) {
  const TwoSeedFloor white = two_seed_floor(smooth_scene(160, 400), sixty_db, {1, 1, false, {1, 1}, 1});
  const TwoSeedFloor wide = two_seed_floor(smooth_scene(160, 400), sixty_db, {1, 1, false, {2.5, 3.5}, 1});
  EXPECT_NEAR(wide.drawn.mse, white.drawn.mse, 0.03 * white.drawn.mse);
  const TwoSeedFloor biased = two_seed_floor(smooth_scene(160, 400), sixty_db, {1, 1, true, {2.5, 3.5}, 1});
  EXPECT_NEAR(biased.drawn.mse, biased.analytic.mse, 0.05 * biased.analytic.mse);  // the power of the filter is 1
}

TEST(ImageComparison, of_an_image_with_itself_is_0) {
  const ImageComparison c = compare_level_images(speckled(1), speckled(1), {sixty_db});
  EXPECT_EQ(c.similarity.front().similarity.mse, 0);
  EXPECT_DOUBLE_EQ(c.similarity.front().similarity.ssim, 1);
  EXPECT_EQ(c.bias_db, 0);
  EXPECT_EQ(c.deviation_db, 0);
  EXPECT_EQ(c.wasserstein_db, 0);
  EXPECT_EQ(c.samples.distance, 0);
  EXPECT_NEAR(c.shift.correlation, 1, 1e-9);
}

TEST(ImageComparison, of_a_gain_is_the_gain_and_nothing_after_it) {
  ComparedImage louder = speckled(1);
  louder.level_db += 4.5F;
  const ImageComparison c = compare_level_images(louder, speckled(1), {GreyWindow{-20, 80}});
  EXPECT_NEAR(c.bias_db, 4.5, 1e-5);
  EXPECT_NEAR(c.power_bias_db, 4.5, 1e-5);
  EXPECT_NEAR(c.wasserstein_db, 4.5, 1e-5);
  EXPECT_NEAR(c.wasserstein_after_gain_db, 0, 1e-5);
  EXPECT_NEAR(c.similarity[0].similarity.mse, 4.5 * 4.5, 0.3);
  EXPECT_NEAR(c.similarity[1].similarity.mse, 0, 1e-9);
}

// Pixels that are silent in one image say nothing of the gain between both.
TEST(ImageComparison, of_an_image_with_silence_is_the_gain_where_both_have_levels) {
  ComparedImage louder = speckled(1), quiet = speckled(1);
  louder.level_db += 4.5F;
  louder.level_db.leftCols(100).setConstant(std::numeric_limits<float>::quiet_NaN());
  quiet.level_db.leftCols(100) -= 200;
  const ImageComparison c = compare_level_images(louder, quiet, {GreyWindow{-20, 80}});
  EXPECT_NEAR(c.power_bias_db, 4.5, 1e-5);
  EXPECT_NEAR(c.bias_db, 4.5, 1e-5);
}

TEST(ImageComparison, fits_a_time_varied_gain_and_a_map_of_grey) {
  ComparedImage a = speckled(1), b = speckled(2);
  for (Eigen::Index n = 0; n < 400; ++n)
    a.level_db.col(n) += static_cast<float>(12 * std::log10(b.gate->centre(static_cast<std::size_t>(n))));
  EXPECT_NEAR(compare_level_images(a, b, {sixty_db}).tvg_slope_db, 12, 0.4);
  // A logarithm of another base, of a scene whose level does not depend on range: else a TVG explains a part of it.
  for (ComparedImage* image : {&a, &b}) {
    image->level_db = with_speckle(smooth_scene(160, 1).replicate(1, 400), image == &a ? 3 : 4);
  }
  b.level_db = 10 + 0.5F * b.level_db;
  const ImageComparison c = compare_level_images(a, b, {sixty_db});
  EXPECT_NEAR(c.map_slope, 0.5, 0.01);
  EXPECT_EQ(c.similarity.back().fitted, "gain, TVG and map");
  EXPECT_GT(c.similarity.back().similarity.psnr_db, c.similarity[1].similarity.psnr_db + 1);
}

TEST(ImageComparison, of_an_expected_level_has_the_floor_of_one_draw) {
  const ComparedImage expected{smooth_scene(160, 400), std::nullopt, std::nullopt, std::nullopt, true};
  const ImageComparison c = compare_level_images(expected, speckled(2), {sixty_db});
  EXPECT_NEAR(c.bias_db, 2.507, 0.06);
  EXPECT_NEAR(c.power_bias_db, 0, 0.05);
  EXPECT_NEAR(c.floor.analytic.mse, 5.570 * 5.570 + 2.507 * 2.507, 0.02);
  EXPECT_NEAR(c.similarity.front().similarity.psnr_db, c.floor.drawn.psnr_db, 0.15);
}

TEST(ImageComparison, leaves_out_what_is_clipped) {
  ComparedImage clipped = speckled(1);
  clipped.scale = GreyWindow{30, 45};
  clipped.level_db = clipped.level_db.max(30).min(45);
  const ImageComparison c = compare_level_images(clipped, speckled(1), {sixty_db});
  EXPECT_EQ(c.deviation_db, 0);  // equal where it is not clipped
  EXPECT_GT(c.a.clipped, 0.2);
  EXPECT_EQ(c.b.clipped, 0);
  EXPECT_GT(c.similarity.front().similarity.mse, 1);  // the picture itself is
}

TEST(ImageComparison, finds_a_shift) {
  const Grid<float> scene = with_speckle(smooth_scene(200, 500), 9, 4);
  const ImageShift shift = find_shift(scene.block(10, 20, 150, 400), scene.block(7, 31, 150, 400));
  EXPECT_EQ(shift.beams, -3);
  EXPECT_EQ(shift.bins, 11);
  EXPECT_GT(shift.correlation, 0.999);
  EXPECT_LT(shift.correlation_at_0, 0.99);
  const Grid<float> moved = without_shift(scene.block(10, 20, 150, 400), shift), b = scene.block(7, 31, 150, 400);
  EXPECT_TRUE((moved.isNaN() || moved == b).all());
  EXPECT_EQ(moved.isNaN().count(), 150 * 400 - 147 * 389);
}

TEST(ImageComparison, resamples_by_mean_intensity_where_it_looked) {
  ComparedImage image{Grid<float>(2, 6), BeamFan{{0.1, -0.1}, {0, 0}, 0.2, 0.2}, RangeGate{1, 1.6, 0.1}};
  image.level_db << 10, 20, 30, 40, 50, 60, 1, 2, 3, 4, 5, 6;
  const Grid<float> half = resampled(image, BeamFan{{-0.12, 0.11, 0.6}, {0, 0, 0}, 0.2, 0.2}, RangeGate{1, 1.8, 0.2});
  EXPECT_NEAR(half(1, 0), db_from_power((10 + 100) / 2.0), 1e-4);
  EXPECT_NEAR(half(0, 2), db_from_power((power_from_db(5) + power_from_db(6)) / 2), 1e-4);
  EXPECT_TRUE(std::isnan(half(1, 3)));  // beyond the last bin
  EXPECT_TRUE(std::isnan(half(2, 0)));  // beyond the last beam
  expect_error(ErrorKind::argument, {"no geometry"}, [&] { resampled({image.level_db}, *image.fan, *image.gate); });
  expect_error(ErrorKind::content, {"do not overlap", "1 to 1.6 m and 5 to 6 m"}, [&] {
    resampled(image, *image.fan, RangeGate{5, 6, 0.1});
  });
}

TEST(ImageComparison, refuses_other_sizes_and_silence) {
  ComparedImage small = speckled(1);
  small.level_db = Grid<float>(small.level_db.topRows(80));
  expect_error(ErrorKind::argument, {"80 x 400 and 160 x 400"}, [&] { compare_level_images(small, speckled(1)); });
  ComparedImage silent = speckled(1);
  silent.level_db.setConstant(-200);
  expect_error(ErrorKind::content, {"no pixel has a level in both"},
               [&] { compare_level_images(silent, speckled(1)); });
}
