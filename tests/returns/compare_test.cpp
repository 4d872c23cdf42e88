// SPDX-License-Identifier: BSD-3-Clause
#include "returns/compare.hpp"

#include "core/random.hpp"
#include "support/test.hpp"

namespace {
ComplexGrid speckle(std::uint64_t seed) {
  ComplexGrid image(40, 50);
  for (Eigen::Index i = 0; i < image.size(); ++i)
    image(i) = random_complex_normal(seed, RandomStage::noise, {static_cast<std::uint64_t>(i), 0, 0});
  return image;
}
}  // namespace

TEST(CompareImages, finds_no_difference_between_equals) {
  const ImageDifference d = compare_images(speckle(1), speckle(1));
  EXPECT_EQ(d.relative_l2, 0);
  EXPECT_EQ(d.max_level_db, 0);
  EXPECT_NEAR(d.correlation, 1, 1e-12);
}

TEST(CompareImages, distinguishes_gain_from_decorrelation) {
  const ImageDifference gain = compare_images(2 * speckle(1), speckle(1));
  EXPECT_NEAR(gain.mean_level_db, 6.0206, 1e-4);
  EXPECT_NEAR(gain.max_level_db, 6.0206, 1e-4);
  EXPECT_NEAR(gain.relative_l2, 1, 1e-12);
  EXPECT_NEAR(gain.correlation, 1, 1e-12);
  // Independent speckle of 2000 samples: correlation about 1/sqrt(2000), mean level within a few tenths of a dB.
  const ImageDifference other = compare_images(speckle(2), speckle(1));
  EXPECT_LT(other.correlation, 0.07);
  EXPECT_NEAR(other.mean_level_db, 0, 0.5);
}

TEST(CompareImages, refuses_images_that_cannot_be_compared) {
  EXPECT_THROW(compare_images(speckle(1), ComplexGrid::Zero(3, 3)), Error);
  EXPECT_THROW(compare_images(speckle(1), ComplexGrid::Zero(40, 50)), Error);
}
