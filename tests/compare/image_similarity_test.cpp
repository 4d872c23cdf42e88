// SPDX-License-Identifier: BSD-3-Clause
// MSE, PSNR and SSIM against scikit-image, and their closed forms (E120).
#include "compare/image_similarity.hpp"

#include "support/test.hpp"

namespace {

/// Returns a deterministic image of 64 x 80 levels.
Grid<float> ripples(double mean, double phase, int row_factor, int column_factor, int modulus) {
  Grid<float> image(64, 80);
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 80; ++j)
      image(i, j) = static_cast<float>(mean + 25 * std::sin(0.3 * i + phase) * std::cos(0.17 * j) +
                                       (i * row_factor + j * column_factor) % modulus / double(modulus) * 20);
  return image;
}
const Grid<float> ripples_a = ripples(30, 0, 7919, 104729, 97), ripples_b = ripples(28, 0.2, 6151, 7907, 89);

}  // namespace

// scikit-image 0.19.3 (Debian 12, numpy 1.24.2) on the same images, clipped to the window in double:
// mean_squared_error, peak_signal_noise_ratio(data_range = span), structural_similarity(data_range = span,
// gaussian_weights = True, sigma = 1.5, use_sample_covariance = False).
TEST(ImageSimilarity, is_that_of_scikit_image) {
  const ImageSimilarity wide = image_similarity(ripples_a, ripples_b, {0, 60});
  EXPECT_NEAR(wide.mse, 70.450718386385, 1e-6);
  EXPECT_NEAR(wide.psnr_db, 17.084170747960, 1e-6);
  EXPECT_NEAR(wide.ssim, 0.482670144545, 1e-6);
  const ImageSimilarity narrow = image_similarity(ripples_a, ripples_b, {20, 45});
  EXPECT_NEAR(narrow.mse, 38.229173208207, 1e-6);
  EXPECT_NEAR(narrow.psnr_db, 12.134851118178, 1e-6);
  EXPECT_NEAR(narrow.ssim, 0.438093487831, 1e-6);
}

TEST(ImageSimilarity, of_an_image_with_itself_is_perfect) {
  const ImageSimilarity same = image_similarity(ripples_a, ripples_a, {0, 60});
  EXPECT_EQ(same.mse, 0);
  EXPECT_TRUE(std::isinf(same.psnr_db));
  EXPECT_DOUBLE_EQ(same.ssim, 1);
  EXPECT_EQ(same.pixels, 64U * 80U);
}

TEST(ImageSimilarity, of_a_shift_in_level_is_its_square) {
  const ImageSimilarity shifted = image_similarity(ripples_a + 3, ripples_a, {-60, 120});
  EXPECT_NEAR(shifted.mse, 9, 1e-4);
  EXPECT_NEAR(shifted.psnr_db, 20 * std::log10(180.0 / 3), 1e-4);
}

TEST(ImageSimilarity, leaves_out_pixels_and_windows_that_are_not_measured) {
  Grid<float> holed = ripples_a, wrong = ripples_b;
  holed(30, 40) = std::numeric_limits<float>::quiet_NaN();
  wrong(30, 40) = 1000;  // counts nowhere
  const ImageSimilarity left = image_similarity(holed, wrong, {0, 60});
  EXPECT_EQ(left.pixels, 64U * 80U - 1);
  EXPECT_LT(std::abs(left.mse - image_similarity(ripples_a, ripples_b, {0, 60}).mse), 0.1);
  EXPECT_FALSE(std::isnan(left.ssim));
  EXPECT_TRUE(std::isnan(image_similarity(ripples_a.topRows(10), ripples_b.topRows(10), {0, 60}).ssim));
}

TEST(ImageSimilarity, refuses_other_sizes_windows_and_empty_images) {
  expect_error(ErrorKind::argument, {"image_similarity", "64 x 80 and 63 x 80", "same size"}, [] {
    image_similarity(ripples_a, ripples_a.topRows(63), {0, 60});
  });
  expect_error(ErrorKind::argument, {"window = 60 to 0 dB", "ascend"}, [] {
    image_similarity(ripples_a, ripples_b, {60, 0});
  });
  const Grid<float> nothing = Grid<float>::Constant(64, 80, std::numeric_limits<float>::quiet_NaN());
  expect_error(ErrorKind::content, {"no pixel has a level in both"}, [&] {
    image_similarity(ripples_a, nothing, {0, 60});
  });
}
