// SPDX-License-Identifier: BSD-3-Clause
// Samples as pixels of pictures.
#include "returns/picture_grid.hpp"

#include "support/test.hpp"

namespace {

const BeamFan three_beams{{radians(-20.0), 0, radians(20.0)}, {0, 0, 0}, radians(20.0), 0.3};

}  // namespace

TEST(PictureGrid, polar_pictures_have_port_on_the_left_and_far_on_top) {
  Grid<std::uint8_t> samples(3, 2);
  samples << 1, 2, 3, 4, 5, 6;
  Grid<std::uint8_t> expected(2, 3);
  expected << 6, 4, 2, 5, 3, 1;
  EXPECT_TRUE((polar_picture(samples, three_beams) == expected).all());
}

TEST(PictureGrid, every_pixel_of_a_fan_shows_the_sample_that_is_there) {
  const RangeGate gate{2, 6, 0.5};
  const FanRaster r = fan_raster(three_beams, gate, 200);
  std::size_t inside = 0;
  for (Eigen::Index row = 0; row < r.beam.rows(); ++row)
    for (Eigen::Index column = 0; column < r.beam.cols(); ++column) {
      const double ahead = (r.head_row - static_cast<double>(row) - 0.5) * r.metres_per_pixel;
      const double starboard = (static_cast<double>(column) + 0.5 - r.head_column) * r.metres_per_pixel;
      const double range = std::hypot(ahead, starboard), bearing = degrees(std::atan2(starboard, ahead));
      const bool in_fan = std::abs(bearing) < 30 && range > 2 && range < 6;
      if (std::abs(std::abs(bearing) - 30) < 0.01 || std::abs(std::abs(bearing) - 10) < 0.01) continue;
      ASSERT_EQ(r.beam(row, column) >= 0, in_fan) << bearing << " deg, " << range << " m";
      if (!in_fan) continue;
      ++inside;
      EXPECT_EQ(r.beam(row, column), bearing < -10 ? 2 : bearing > 10 ? 0 : 1);
      EXPECT_EQ(r.bin(row, column), static_cast<int>((range - 2) / 0.5));
    }
  const double area = pi / 6 * (36 - 4);  // of a sixth of a ring
  EXPECT_NEAR(static_cast<double>(inside) * r.metres_per_pixel * r.metres_per_pixel, area, 0.02 * area);
}

TEST(PictureGrid, fans_of_several_elevations_or_astern_are_refused) {
  const RangeGate gate{2, 6, 0.5};
  expect_error(ErrorKind::argument, {"fan_raster", "several elevations"}, [&] {
    fan_raster({{0, 0}, {0, 0.1}, 0.1, 0.1}, gate, 64);
  });
  expect_error(ErrorKind::argument, {"must look ahead"}, [&] { fan_raster({{-2, 2}, {0, 0}, 0.1, 0.1}, gate, 64); });
  expect_error(ErrorKind::argument, {"columns = 8", "16 and 8192"}, [&] { fan_raster(three_beams, gate, 8); });
}
