// SPDX-License-Identifier: BSD-3-Clause
// Rasters in any projected system, against its equations from the literature, in the plane of the world, and mosaics.
#include <map>
#include <sstream>

#include "core/geodesy.hpp"
#include "formats/tiff_decoder.hpp"
#include "support/test.hpp"
#include "tool/mission_text.hpp"
#include "tool/tool_runner.hpp"
#include "view/save_vtk.hpp"

namespace {

/// A Lambert conformal conic projection with two standard parallels on GRS 80; angles in degrees, easting and northing
/// in metres. Snyder 1987, "Map projections", equations 14-15, 15-1 to 15-11.
struct LambertConic {
  double first, second, latitude, longitude, easting, northing;

  static double m(double phi) {
    const double s = std::sin(phi);
    return std::cos(phi) / std::sqrt(1 - e2 * s * s);
  }
  static double t(double phi) {
    const double s = std::sqrt(e2) * std::sin(phi);
    return std::tan(pi / 4 - phi / 2) / std::pow((1 - s) / (1 + s), std::sqrt(e2) / 2);
  }
  Eigen::Vector2d operator()(double lat, double lon) const {
    const double p1 = radians(first), p2 = radians(second);
    const double n = std::log(m(p1) / m(p2)) / std::log(t(p1) / t(p2)), f = m(p1) / (n * std::pow(t(p1), n));
    const double rho = a * f * std::pow(t(radians(lat)), n), rho0 = a * f * std::pow(t(radians(latitude)), n);
    const double theta = n * radians(lon - longitude);
    return {easting + rho * std::sin(theta), northing + rho0 - rho * std::cos(theta)};
  }
  static constexpr double a = 6378137, flattening = 1 / 298.257222101, e2 = flattening * (2 - flattening);
};

constexpr double survey_foot = 1200.0 / 3937;

class ExportCrs : public ToolTest {
 protected:
  void SetUp() override {
    write("bed.obj", "v -6 -6 -5\nv 6 -6 -5\nv 6 6 -4\nv -6 6 -4\nf 1 2 3\nf 1 3 4\n");
    have("out",
         "ping bed.obj --sonar em2040 --pose=0,0,0,0,0,0 --range 2:8 --set sonar.beams=48 "
         "--set sonar.field_of_view_deg=90");
  }
  /// Two columns of the soundings as CSV has them.
  std::vector<Eigen::Vector2d> soundings(const std::string& anchor, const char* first, const char* second) const {
    succeed("export out --to csv -q --force -o s.csv --anchor " + anchor);
    std::vector<Eigen::Vector2d> found;
    for (const auto& row : rows_of(read("s.csv")))
      found.emplace_back(std::stod(row.at(first)), std::stod(row.at(second)));
    return found;
  }
  /// Every sounding is counted in the cell that holds its position [m], and no other is.
  static void expect_counted(const decode::GeotiffContent& map, const std::vector<Eigen::Vector2d>& positions,
                             double unit) {
    std::vector<float> expected(map.bands.at(2).size(), 0);
    for (const Eigen::Vector2d& position : positions) {
      const auto column = static_cast<std::size_t>(std::floor((position.x() / unit - map.west) / map.cell));
      const auto row = static_cast<std::size_t>(std::floor((map.north - position.y() / unit) / map.cell));
      ASSERT_LT(column, map.columns);
      ASSERT_LT(row, map.rows);
      expected[row * map.columns + column] += 1;
    }
    EXPECT_EQ(map.bands[2], expected);
  }
  void expect_projected(int epsg, const std::string& anchor, const LambertConic& system, double unit) {
    succeed("export out --to geotiff --cell 0.7 -q -o m.tif --crs EPSG:" + std::to_string(epsg) + " --anchor " +
            anchor);
    const decode::GeotiffContent map = decode::read_geotiff(read("m.tif"));
    EXPECT_EQ(map.epsg, epsg);
    EXPECT_NEAR(map.cell, 0.7 / unit, 1e-12);
    std::vector<Eigen::Vector2d> positions = soundings(anchor, "latitude_deg", "longitude_deg");
    ASSERT_GT(positions.size(), 40U);
    for (Eigen::Vector2d& position : positions) position = system(position.x(), position.y());
    expect_counted(map, positions, unit);
  }
};

}  // namespace

TEST_F(ExportCrs, lays_soundings_where_the_equations_of_the_system_have_them) {
  if (!with_gdal) GTEST_SKIP() << "built without GDAL";
  // RGF93 v1 / Lambert-93, and NAD83 / New York Long Island in feet of the US survey.
  expect_projected(2154, "48.2,2.5,30", {44, 49, 46.5, 3, 700000, 6600000}, 1);
  std::filesystem::remove(path("m.tif"));
  expect_projected(2263, "40.7,-74,300", {40 + 40 / 60.0, 41 + 2 / 60.0, 40 + 10 / 60.0, -74, 984250 * survey_foot, 0},
                   survey_foot);
}

TEST_F(ExportCrs, a_zone_by_its_code_is_the_zone_by_default) {
  if (!with_gdal) GTEST_SKIP() << "built without GDAL";
  succeed("export out --to geotiff -q -o a.tif --anchor -33.9,-71.5,40");
  succeed("export out --to geotiff -q -o b.tif --anchor -33.9,-71.5,40 --crs epsg:32719");
  EXPECT_EQ(read("a.tif"), read("b.tif"));
}

TEST_F(ExportCrs, the_plane_of_the_world_needs_no_place_on_the_globe) {
  succeed("export out --to geotiff --cell 0.5 --crs local -q -o local.tif");
  auto tags = decode::tiff_tags(read("local.tif"));
  EXPECT_EQ(tags.at(34735),
            (std::vector<double>{1, 1, 1, 4, 1024, 0, 1, 32767, 1025, 0, 1, 1, 1026, 34737, 21, 0, 3076, 0, 1, 9001}));
  std::string name;
  for (const double c : tags.at(34737)) name.push_back(static_cast<char>(c));
  EXPECT_EQ(name, std::string("local grid of metres|\0", 22));
  decode::GeotiffContent map = decode::read_geotiff(read("local.tif"));
  expect_counted(map, soundings("54,8", "x_m", "y_m"), 1);
  succeed("export out --to geotiff --cell 0.5 --crs local --anchor 54,8,123 -q -o anchored.tif");
  EXPECT_EQ(read("anchored.tif"), read("local.tif"));
}

TEST_F(ExportCrs, refuses_systems_that_cannot_work_with_a_remedy) {
  const std::string to = "export out --to geotiff -o no.tif --anchor 48.2,-4.5 --crs ";
  expect_refused(to + "utm", 2, {"--crs 'utm'", "EPSG:N", "or local"});
  expect_refused(to + "EPSG:2154x", 2, {"--crs 'EPSG:2154x'", "EPSG:N"});
  expect_refused("export out --to geotiff -o no.tif", 2, {"--anchor", "--crs local"});
  expect_refused("export out --to geotiff -o no.tif --crs EPSG:2154", 2, {"--anchor", "--crs local"});
  expect_refused("export out --to las -o no.las --anchor 48,2 --crs EPSG:2154", 2, {"--crs goes with --to geotiff"});
  if (!with_gdal) {
    expect_refused(to + "EPSG:2154", 1, {"needs GDAL", "leave --crs out for UTM"});
    return;
  }
  expect_refused(to + "EPSG:4326", 2, {"EPSG:4326 (WGS 84)", "degrees", "projected system"});
  expect_refused(to + "EPSG:4978", 2, {"EPSG:4978", "earth-centred"});
  expect_refused(to + "EPSG:7415", 2, {"EPSG:7415", "no projected system alone"});
  expect_refused(to + "EPSG:2048", 2, {"EPSG:2048", "WEST and the SOUTH", "north up"});
  expect_refused(to + "EPSG:31000", 2, {"EPSG:31000 is not known", "epsg.org"});
  expect_refused(to + "EPSG:99", 2, {"EPSG:99", "within 1024 and 32766"});
  expect_refused(to + "EPSG:2263", 2,
                 {"New York Long Island", "does not reach to latitude 48", "system of that place"});
  EXPECT_FALSE(std::filesystem::exists(path("no.tif")));
}

// Each cell of the GeoTIFF is the cell of the mosaic at the position of its middle in the world, whose x axis points to the
// north-west here.
TEST_F(ExportCrs, mosaics_are_north_up_where_the_mission_has_an_anchor) {
  write("line.toml", text_of({.survey = "anchor = { latitude_deg = 54.1, longitude_deg = 7.9, heading_deg = -50 }",
                              .way = "[-1, 0, 0], [1, 0, 0]",
                              .sonar = "em2040",
                              .range = "2:8",
                              .head = "set = [\"sonar.beams=64\", \"sonar.field_of_view_deg=90\"]\nevery_m = 0.5"}));
  succeed("survey line.toml -q -o run");
  succeed("merge -q run --mosaic 0.2");
  const decode::GeotiffContent map = decode::read_geotiff(read("run/mosaic.tif"));
  const HorizontalMap mosaic = load_map_image(path("run/mosaic.vti"));
  EXPECT_EQ(map.epsg, 32632);
  EXPECT_EQ(map.cell, 0.2);
  ASSERT_EQ(map.bands.size(), 2U);
  const Grid<float>& strength = mosaic.fields.at(0).values;  // columns x rows
  std::size_t beam_azimuth = 0, edges = 0;
  for (std::size_t row = 0; row < map.rows; ++row)
    for (std::size_t column = 0; column < map.columns; ++column) {
      const UtmPosition middle{map.west + 0.2 * (static_cast<double>(column) + 0.5),
                               map.north - 0.2 * (static_cast<double>(row) + 0.5)};
      const Eigen::Vector3d at = world_from_geo({54.1, 7.9, -50}, geo_position_of(middle, {32, true}));
      const double x = (at.x() - mosaic.x) / 0.2, y = (at.y() - mosaic.y) / 0.2;
      const float value = map.bands[0][row * map.columns + column];
      if (std::abs(x - std::round(x)) < 1e-4 || std::abs(y - std::round(y)) < 1e-4) {
        ++edges;
        continue;
      }
      const bool inside =
          x > 0 && y > 0 && x < static_cast<double>(strength.rows()) && y < static_cast<double>(strength.cols());
      const float expected =
          inside ? strength(static_cast<Eigen::Index>(x), static_cast<Eigen::Index>(y)) : std::nanf("");
      if (std::isnan(expected)) {
        EXPECT_TRUE(std::isnan(value));
      } else {
        EXPECT_EQ(value, expected);
        ++beam_azimuth;
      }
    }
  EXPECT_LT(edges, 50U);
  // None is lost: turned by 50 degrees, the map has as many cells on the same ground.
  EXPECT_NEAR(static_cast<double>(beam_azimuth), static_cast<double>((strength.isFinite()).count()),
              0.05 * static_cast<double>(beam_azimuth));

  succeed("merge -q run --mosaic 0.2 --crs local");
  const decode::GeotiffContent local = decode::read_geotiff(read("run/mosaic.tif"));
  EXPECT_NEAR(local.west, mosaic.x, 1e-9);
  ASSERT_EQ(local.columns, static_cast<std::size_t>(strength.rows()));
  ASSERT_EQ(local.rows, static_cast<std::size_t>(strength.cols()));
  for (std::size_t i = 0; i < local.bands[0].size(); ++i) {
    const auto row = static_cast<Eigen::Index>(local.rows - 1 - i / local.columns);
    const float expected = strength(static_cast<Eigen::Index>(i % local.columns), row);
    if (std::isnan(expected))
      EXPECT_TRUE(std::isnan(local.bands[0][i]));
    else
      EXPECT_EQ(local.bands[0][i], expected);
  }
  write("nowhere.toml",
        replaced(read("line.toml"), "anchor = { latitude_deg = 54.1, longitude_deg = 7.9, heading_deg = -50 }\n", ""));
  succeed("survey nowhere.toml -q -o nowhere");
  expect_refused("merge nowhere --mosaic 0.2 --crs EPSG:32632", 2, {"--anchor", "--crs local"});
  succeed("merge -q nowhere --mosaic 0.2");
  EXPECT_FALSE(std::filesystem::exists(path("nowhere/mosaic.tif")));
  expect_refused("merge run --crs local", 2, {"--crs goes with --mosaic"});
}
