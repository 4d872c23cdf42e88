// SPDX-License-Identifier: BSD-3-Clause
#include "tool/export/sounding_map.hpp"

#include "formats/ros_messages.hpp"
#include "support/page.hpp"
#include "support/test.hpp"
#include "tool/dataset/dataset.hpp"

using tool::cell_of, tool::SoundingMap;

// The cells of a grid are half open: an edge belongs to the cell that begins there, whatever its coordinate is rounded to.
TEST(SoundingMap, gives_a_sounding_on_an_edge_to_the_cell_that_begins_there) {
  for (const double cell : {0.1, 0.25, 0.3, 0.5, 1.0})
    for (const double zero : {-100000.0, 0.0, 54000.0, 5654000.0})
      for (int k = 0; k < 300; ++k) {
        const double edge = std::round((zero + k) * cell * 1e6) / 1e6;  // as written in decimal
        const auto number = static_cast<std::int64_t>(zero) + k;
        EXPECT_EQ(cell_of(edge, cell), number) << edge << " by " << cell;
        EXPECT_EQ(cell_of(edge - 2e-6, cell), number - 1) << edge << " by " << cell;
        EXPECT_EQ(cell_of(edge + cell - 2e-6, cell), number) << edge << " by " << cell;
      }
  // Four soundings on corners of cells: one in each.
  SoundingMap map(0.1);
  for (const double x : {565400.1, 565400.2})
    for (const double y : {5995100.3, 5995100.4}) map.add({x, y, -10 * x - y}, 1);
  const std::vector<GeoBand> bands = map.bands();
  ASSERT_EQ(bands[2].values.rows(), 2);
  ASSERT_EQ(bands[2].values.cols(), 2);
  EXPECT_TRUE((bands[2].values == 1).all());
  EXPECT_TRUE(bands[3].values.isNaN().all());  // of one sounding there is no deviation
  EXPECT_NEAR(map.grid().west, 565400.1, 1e-9);
  EXPECT_NEAR(map.grid().south, 5995100.3, 1e-9);
}

TEST(SoundingMap, has_bands_of_height_level_number_deviation_and_extremes) {
  SoundingMap map(1);
  for (const double z : {-4000.5, -4000.25, -4000.0}) map.add({0.5, 0.5, z}, 100);
  const std::vector<GeoBand> bands = map.bands();
  ASSERT_EQ(bands.size(), 6U);
  const double expected[] = {-4000.25, 20, 3, 0.25, -4000.5, -4000};
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(static_cast<double>(bands[k].values(0, 0)), expected[k], 1e-4) << bands[k].name;
}

// A rejected sounding far from the bed moves no band of the bed, and has its own.
TEST(SoundingMap, keeps_rejected_soundings_apart) {
  SoundingMap map(1);
  map.add({0.5, 0.5, -7}, 100);
  map.add_rejected({0.5, 0.5, -13});
  map.add_rejected({0.5, 0.5, -12});
  map.add_rejected({1.5, 0.5, -20});
  EXPECT_EQ(map.bands().size(), 6U);
  const std::vector<GeoBand> bands = map.bands(true);
  ASSERT_EQ(bands.size(), 8U);
  const double first[] = {-7, 20, 1, NAN, -7, -7, 2, -12.5}, second[] = {NAN, NAN, 0, NAN, NAN, NAN, 1, -20};
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_THAT(bands[k].values(0, 0), testing::NanSensitiveFloatEq(static_cast<float>(first[k]))) << bands[k].name;
    EXPECT_THAT(bands[k].values(0, 1), testing::NanSensitiveFloatEq(static_cast<float>(second[k]))) << bands[k].name;
  }
}

namespace {

/// A section of the page of exports: heading, first cell of the head, and rows of name, unit, type and meaning.
std::string section_of_export(const std::string& heading, const std::string& rows) {
  return "\n## " + heading + "\n\n| name | unit | type | meaning |\n|---|---|---|---|\n" + rows;
}

std::string row_of_export(const std::string& name, const char* unit, const char* type, const char* meaning) {
  return "|" + table_cell("`" + name + "`") + table_cell(unit) + table_cell(type) + table_cell(meaning) + "\n";
}

}  // namespace

TEST(SoundingMap, and_other_exports_have_the_columns_of_the_page) {
  std::string csv, bands, points, splits;
  for (const tool::BandMeaning& column : tool::csv_columns)
    csv += row_of_export(column.name, column.unit, "text", column.meaning);
  for (const tool::BandMeaning& band : tool::sounding_bands)
    bands += row_of_export(band.name, band.unit, "float32", band.meaning);
  for (const RosPointField& field : ros_point_fields)
    points += row_of_export(field.name, field.unit, field.type, field.meaning);
  for (const tool::SplitUnit& unit : tool::split_units())
    splits += "|" + table_cell(std::string("`") + unit.name + "`") + table_cell(unit.means) + "\n";
  expect_reference_page(
      "exports.md",
      "# Columns and bands of exports\n\n[exports.md](../exports.md) explains soundings and products.\n" +
          section_of_export("Columns of CSV", csv) + section_of_export("Bands of GeoTIFF", bands) +
          section_of_export("Fields of /sonar/points in MCAP", points) +
          "\n## Splits of data sets\n\n| `--split-by` | what stays together in train, val or test |\n|---|---|\n" +
          splits);
}

// Opens a map with gdalinfo, where it is installed.
TEST(SoundingMap, is_opened_by_gdal) {
  if (std::system("gdalinfo --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "gdal-bin is not installed";
  SoundingMap map(0.5);
  for (int i = 0; i < 12; ++i) map.add({565400 + 0.3 * i, 5995100 + 0.2 * i, -10 - 0.125 * i}, 100);
  GeoGrid grid = map.grid();
  grid.epsg = 32632;
  const std::string path = own_path("map.tif"), out = own_path("info.txt");
  write_geotiff(path, map.bands(), grid);
  ASSERT_EQ(std::system(("gdalinfo " + path + " >" + out + " 2>&1").c_str()), 0);
  const std::string info = file_bytes(out);
  for (const char* part : {"ID[\"EPSG\",32632]", "Origin = (565400.0", "Pixel Size = (0.5", "Description = deviation",
                           "Unit Type: m", "Unit Type: dB re 1 uPa at 1 m", "NoData Value=nan"})
    EXPECT_THAT(info, HasSubstr(part));
  EXPECT_THAT(info, testing::Not(HasSubstr("Warning")));
}
