// SPDX-License-Identifier: BSD-3-Clause
// Pixels of pictures in true geometry hold all that lies within them.
#include "returns/fan_areas.hpp"

#include <random>

#include "returns/ping.hpp"
#include "support/test.hpp"

namespace insonify::fan_areas_tests {

const RangeGate fine_gate{2, 6, 0.01};

BeamFan even_fan(std::size_t beams, double half_width) {
  BeamFan fan{{}, std::vector<double>(beams, 0.0), radians(2.0), 0.3};
  for (std::size_t b = 0; b < beams; ++b)
    fan.azimuth.push_back(half_width * (2 * (static_cast<double>(b) + 0.5) / static_cast<double>(beams) - 1));
  return fan;
}

struct Samples {
  Grid<float> level_db;
  Grid<std::uint8_t> category;
  Grid<std::uint16_t> instance;

  Samples(const BeamFan& fan, float level)
      : level_db(Grid<float>::Constant(static_cast<Eigen::Index>(fan.beams()),
                                       static_cast<Eigen::Index>(fine_gate.bins()), level)),
        category(Grid<std::uint8_t>::Zero(level_db.rows(), level_db.cols())),
        instance(Grid<std::uint16_t>::Zero(level_db.rows(), level_db.cols())) {}
  FanSamples view() const { return {level_db, category, instance}; }
};

TEST(FanAreas, mean_intensity_is_that_of_many_points_within_the_pixel) {
  const BeamFan fan = even_fan(24, radians(60.0));
  Samples samples(fan, 0);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> level(0, 20);
  for (float& l : samples.level_db.reshaped()) l = level(random);
  const FanRaster raster = fan_raster(fan, fine_gate, 60);
  const FanPixels pixels = fan_pixels(samples.view(), fan, fine_gate, raster);
  // The referee looks up the sample at 100 x 100 points of each pixel.
  std::size_t compared = 0;
  double worst = 0;
  for (Eigen::Index row = 0; row < raster.beam.rows(); row += 3)
    for (Eigen::Index column = 0; column < raster.beam.cols(); column += 3) {
      double sum = 0, inside = 0;
      for (int i = 0; i < 100; ++i)
        for (int k = 0; k < 100; ++k) {
          const double x = (raster.head_row - static_cast<double>(row) - (i + 0.5) / 100) * raster.metres_per_pixel;
          const double y =
              (static_cast<double>(column) + (k + 0.5) / 100 - raster.head_column) * raster.metres_per_pixel;
          const double bin = (std::hypot(x, y) - 2) / 0.01, beam = (radians(60.0) - std::atan2(y, x)) / radians(5.0);
          if (bin < 0 || bin >= 400 || beam < 0 || beam >= 24) continue;
          sum += std::pow(10, samples.level_db(static_cast<Eigen::Index>(beam), static_cast<Eigen::Index>(bin)) / 10);
          ++inside;
        }
      if (inside < 3000) continue;
      ++compared;
      worst = std::max(worst, std::abs(pixels.level_db(row, column) - 10 * std::log10(sum / inside)));
    }
  EXPECT_GT(compared, 100U);
  EXPECT_LT(worst, 0.5);  // by rays that are a quarter of a pixel apart; one sample is off by up to 20 dB
}

// A raster that takes one sample for each pixel shows such a target in some positions alone.
TEST(FanAreas, a_target_of_one_sample_is_in_the_picture_wherever_it_is) {
  const BeamFan fan = even_fan(64, radians(60.0));
  const FanRaster raster = fan_raster(fan, fine_gate, 50);  // some 16 bins a pixel
  for (int at = 0; at < 60; ++at) {
    Samples samples(fan, 60);
    const Eigen::Index beam = 4 + (at * 11) % 56, bin = 120 + 3 * at;
    samples.level_db(beam, bin) = 100, samples.category(beam, bin) = 7, samples.instance(beam, bin) = 301;
    const FanPixels pixels = fan_pixels(samples.view(), fan, fine_gate, raster);
    EXPECT_GE((pixels.instance == 301).count(), 1) << at;
    EXPECT_LE((pixels.instance == 301).count(), 9) << at;
    EXPECT_TRUE(((pixels.instance == 301) == (pixels.category == 7)).all());
    // All of its energy, and no more, is in the pixels: level above the others, by the area of the sample.
    const double range = fine_gate.centre(static_cast<std::size_t>(bin));
    const double wide = radians(120.0 / 64);
    double excess = 0;
    for (Eigen::Index i = 0; i < pixels.level_db.size(); ++i)
      if (const float level = pixels.level_db(i); level > 60.001F)
        excess += (std::pow(10, level / 10) - 1e6) * raster.metres_per_pixel * raster.metres_per_pixel;
    EXPECT_NEAR(excess / ((1e10 - 1e6) * range * wide * 0.01), 1, 0.06) << at;
  }
}

TEST(FanAreas, the_class_is_that_of_most_energy_or_area_in_silence) {
  const BeamFan fan = even_fan(8, radians(40.0));
  const FanRaster raster = fan_raster(fan, fine_gate, 16);
  Samples samples(fan, silence_db);
  samples.category.setConstant(1);
  samples.category.rightCols(150).setConstant(2);
  const FanPixels silent = fan_pixels(samples.view(), fan, fine_gate, raster);
  const auto row_of = [&](double ahead) {
    return static_cast<Eigen::Index>(raster.head_row - ahead / raster.metres_per_pixel);
  };
  const auto middle = static_cast<Eigen::Index>(raster.head_column);
  EXPECT_EQ(silent.category(row_of(2.8), middle), 1);
  EXPECT_EQ(silent.category(row_of(5.6), middle), 2);
  EXPECT_EQ(silent.category(0, 0), 0);  // beside the fan
  // One loud bin of another class outweighs the others of its pixel.
  samples.level_db.setConstant(50);
  samples.level_db.col(80).setConstant(90), samples.category.col(80).setConstant(5);
  EXPECT_EQ(fan_pixels(samples.view(), fan, fine_gate, raster).category(row_of(2.805), middle), 5);
  expect_error(ErrorKind::argument, {"fan_pixels: levels of 8 x 400", "8 beams x 40"}, [&] {
    fan_pixels(samples.view(), fan, {2, 6, 0.1}, raster);
  });
}

}  // namespace insonify::fan_areas_tests
