// SPDX-License-Identifier: BSD-3-Clause
#include "formats/geotiff_file.hpp"

#include "formats/tiff_decoder.hpp"
#include "support/test.hpp"

namespace {

constexpr float no_value = std::numeric_limits<float>::quiet_NaN();

/// Returns 2 rows x 3 columns; row 0 is the south.
std::vector<GeoBand> two_bands() {
  Grid<float> height = Grid<float>::Zero(2, 3), count = height;
  height << -20, -21, no_value, -18, -17.5F, -16;
  count << 1, 2, 0, 4, 5, 6;
  std::vector<GeoBand> bands(2);
  bands[0].name = "height", bands[0].unit = "m", bands[0].values = height;
  bands[1].name = "soundings", bands[1].values = count;
  return bands;
}

}  // namespace

TEST(GeotiffFile, holds_what_its_specifications_say) {
  const std::string path = own_path("bed.tif");
  write_geotiff(path, two_bands(), {32733, 565000, 5995000, 0.5});
  const std::string bytes = file_bytes(path);
  auto tags = decode::tiff_tags(bytes);
  EXPECT_EQ(tags[256], std::vector<double>{3});
  EXPECT_EQ(tags[257], std::vector<double>{2});
  EXPECT_EQ(tags[258], (std::vector<double>{32, 32}));
  EXPECT_EQ(tags[339], (std::vector<double>{3, 3}));
  EXPECT_EQ(tags[284], std::vector<double>{2});
  EXPECT_EQ(tags[33550], (std::vector<double>{0.5, 0.5, 0}));
  EXPECT_EQ(tags[33922], (std::vector<double>{0, 0, 0, 565000, 5995001, 0}));  // the north-west corner
  EXPECT_EQ(tags[34735], (std::vector<double>{1, 1, 1, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32733}));
  std::string no_data;
  for (const double c : tags[42113]) no_data.push_back(static_cast<char>(c));
  EXPECT_EQ(no_data, std::string("nan\0", 4));
  std::string metadata;
  for (const double c : tags[42112]) metadata.push_back(static_cast<char>(c));
  EXPECT_THAT(metadata,
              testing::AllOf(HasSubstr("<Item name=\"DESCRIPTION\" sample=\"0\" role=\"description\">height</Item>"),
                             HasSubstr("<Item name=\"UNITTYPE\" sample=\"0\" role=\"unittype\">m</Item>")));
  ASSERT_EQ(tags[273].size(), 2U);
  decode::Cursor heights(bytes, static_cast<std::size_t>(tags[273][0]));
  for (const float expected : {-18.0F, -17.5F, -16.0F, -20.0F, -21.0F})
    EXPECT_EQ(heights.float32(), expected);  // from the north
  EXPECT_TRUE(std::isnan(heights.float32()));
  decode::Cursor counts(bytes, static_cast<std::size_t>(tags[273][1]));
  for (const float expected : {4.0F, 5.0F, 6.0F, 1.0F, 2.0F, 0.0F}) EXPECT_EQ(counts.float32(), expected);
  EXPECT_EQ(bytes.size(), static_cast<std::size_t>(tags[273][1]) + 24);
  const decode::GeotiffContent content = decode::read_geotiff(bytes);
  EXPECT_EQ(content.bands.at(0)[1], -17.5F);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_ANY_THROW(decode::read_geotiff(bytes.substr(0, size))) << size;
}

// Coordinates and cells are in the unit of the system.
TEST(GeotiffFile, of_feet_has_feet) {
  const std::string path = own_path("feet.tif");
  write_geotiff(path, two_bands(), {2263, 304.8, 609.6, 1.524, 0.3048});
  auto tags = decode::tiff_tags(file_bytes(path));
  EXPECT_NEAR(tags[33550][0], 5, 1e-12);
  EXPECT_NEAR(tags[33922][3], 1000, 1e-9);
  EXPECT_NEAR(tags[33922][4], 2010, 1e-9);
}

TEST(GeotiffFile, refuses_what_is_no_raster) {
  const GeoGrid grid{32632, 0, 0, 1};
  EXPECT_THAT(error_of([&] { write_geotiff(own_path("a.tif"), {}, grid); }),
              HasSubstr("bands = 0, must be at least one"));
  std::vector<GeoBand> bands = two_bands();
  bands[1].values = Grid<float>::Zero(1, 3);
  EXPECT_THAT(error_of([&] { write_geotiff(own_path("a.tif"), bands, grid); }), HasSubstr("the same in all bands"));
  EXPECT_THAT(error_of([&] {
                write_geotiff(own_path("a.tif"), two_bands(), {32632, 0, 0, 0});
              }),
              HasSubstr("cell = 0 m, must be > 0"));
}
