// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/elevation_pattern.hpp"

#include "support/test.hpp"

TEST(ElevationPattern, is_one_on_axis_and_half_power_at_half_its_width) {
  for (const auto shape : {ElevationShape::gaussian, ElevationShape::line}) {
    EXPECT_EQ(elevation_response(shape, radians(20), 0), 1);
    EXPECT_NEAR(elevation_response(shape, 0.3, 1e-12), 1, 1e-12);
    EXPECT_NEAR(std::pow(elevation_response(shape, radians(20), radians(10)), 2), 0.5, 1e-6);
    EXPECT_NEAR(std::pow(elevation_response(shape, radians(20), radians(-10)), 2), 0.5, 1e-6);
  }
}

// A uniform line has its first side lobe at -13.26 dB; the Gaussian has none.
TEST(ElevationPattern, of_a_line_has_the_side_lobes_of_a_line) {
  const double first_null = std::asin(std::sin(radians(10)) / 0.4429464715);
  double highest = 0;
  for (double x = first_null; x < 1.2; x += 1e-4)
    highest = std::max(highest, std::abs(elevation_response(ElevationShape::line, radians(20), x)));
  EXPECT_NEAR(db_from_amplitude(highest), -13.26, 0.01);
}

TEST(ElevationPattern, sector_is_cut_at_half_the_width) {
  EXPECT_EQ(elevation_response(ElevationShape::sector, 0.2, 0.0999), 1);
  EXPECT_EQ(elevation_response(ElevationShape::sector, 0.2, 0.1001), 0);
}

TEST(ElevationPattern, is_below_the_floor_beyond_its_half_extent) {
  const double edge = elevation_half_extent(ElevationShape::gaussian, radians(20), -40);
  EXPECT_NEAR(db_from_amplitude(elevation_response(ElevationShape::gaussian, radians(20), edge)), -40, 1e-9);
}

TEST(ElevationPattern, of_any_width_is_between_minus_1_and_1) {
  for (const ElevationShape shape : {ElevationShape::gaussian, ElevationShape::line, ElevationShape::sector})
    for (const double width : {1e-320, 1e-300, 1e-12, 0.1, pi, 10.0, 1e300})
      for (const double off : {-pi / 2, -1e-9, 0.0, 1e-300, 0.3, pi / 2}) {
        EXPECT_LE(std::abs(elevation_response(shape, width, off)), 1) << width << " " << off;
        EXPECT_GE(elevation_half_extent(shape, width, -40), 0);
        EXPECT_LE(elevation_half_extent(shape, width, -40), pi / 2);
      }
}
