// SPDX-License-Identifier: BSD-3-Clause
// Worlds in projected coordinates: exports take the system that the scene states, and what contradicts it is refused.
#include <fmt/format.h>

#include "core/geodesy.hpp"
#include "formats/las_decoder.hpp"
#include "formats/tiff_decoder.hpp"
#include "support/test.hpp"
#include "tool/mission_text.hpp"
#include "tool/tool_runner.hpp"

namespace {

constexpr double west = 500060, south = 5900050;

/// A transverse Mercator system about 9 degrees east, as a file .prj has it.
std::string wkt(int epsg, const std::string& name, const std::string& datum, const std::string& spheroid) {
  return "PROJCS[\"" + name + "\",GEOGCS[\"" + datum + "\",DATUM[\"" + datum + "\",SPHEROID[" + spheroid +
         "]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
         "PARAMETER[\"latitude_of_origin\",0],PARAMETER[\"central_meridian\",9],PARAMETER[\"scale_factor\",0.9996],"
         "PARAMETER[\"false_easting\",500000],PARAMETER[\"false_northing\",0],UNIT[\"metre\",1],AXIS[\"Easting\",EAST],"
         "AXIS[\"Northing\",NORTH],AUTHORITY[\"EPSG\",\"" +
         std::to_string(epsg) + "\"]]";
}

class ProjectedWorld : public ToolTest {
 protected:
  /// A level bed 5 m below a head at its middle, and the same with a file that states its system.
  void SetUp() override {
    std::string grid = fmt::format("ncols 25\nnrows 25\nxllcorner {}\nyllcorner {}\ncellsize 0.5\n", west, south);
    for (int row = 0; row < 25; ++row) {
      for (int column = 0; column < 25; ++column) grid += fmt::format("{:.2f} ", -5 + 0.01 * row);
      grid += "\n";
    }
    write("none.asc", grid), write("bed.asc", grid), write("etrs.asc", grid);
    write("bed.prj", wkt(32632, "WGS 84 / UTM zone 32N", "WGS_1984", "\"WGS 84\",6378137,298.257223563"));
    write("etrs.prj", wkt(25832, "ETRS89 / UTM zone 32N", "European_Terrestrial_Reference_System_1989",
                          "\"GRS 1980\",6378137,298.257222101"));
  }
  static std::string mission(const std::string& scene, const std::string& survey = "") {
    return text_of({.scene = scene,
                    .survey = survey,
                    .way = fmt::format("[{}, {}, 0], [{}, {}, 0]", west + 5, south + 6, west + 7, south + 6),
                    .sonar = "em2040",
                    .range = "2:8",
                    .head = "set = [\"sonar.beams=48\", \"sonar.field_of_view_deg=90\"]\nrate_hz = 1"});
  }
  void ping(const std::string& scene, const std::string& output) const {
    succeed(
        fmt::format("ping {} --sonar em2040 --pose={},{},0,0,0,0 --range 2:8 --set sonar.beams=48 --set "
                    "sonar.field_of_view_deg=90 --no-picture -q -o {}",
                    scene, west + 6, south + 6, output));
  }
};

}  // namespace

TEST_F(ProjectedWorld, exports_take_the_system_that_the_scene_states) {
  if (!with_gdal) GTEST_SKIP() << "built without GDAL";
  ping("bed.asc", "out");
  succeed("export out --to geotiff -q -o a.tif");
  ping("none.asc", "plain");
  expect_refused("export plain --to geotiff -o no.tif", 2,
                 {"does not say where on the globe it is", "--system EPSG:N"});
  succeed("export plain --to geotiff --utm 32N -q -o b.tif");
  EXPECT_EQ(read("a.tif"), read("b.tif"));
  EXPECT_EQ(insonify::decode::read_geotiff(read("a.tif")).epsg, 32632);

  expect_refused("export out --to gsf --utm 18S -o no.gsf", 2, {"--utm 18S is EPSG:32718", "EPSG:32632"});
  expect_refused("export out --to gsf --system EPSG:25832 -o no.gsf", 2, {"EPSG:25832", "EPSG:32632", "leave"});
  expect_refused("export out --to gsf --anchor 54,8 -o no.gsf", 2, {"--anchor", "projected", "EPSG:32632"});
  EXPECT_FALSE(std::filesystem::exists(path("no.gsf")));
}

TEST_F(ProjectedWorld, rasters_lie_in_any_system_of_the_world) {
  if (!with_gdal) GTEST_SKIP() << "built without GDAL";
  ping("etrs.asc", "out");
  succeed("export out --to geotiff --cell 0.5 -q -o own.tif");
  succeed("export out --to geotiff --cell 0.5 --crs local -q -o local.tif");
  const auto own = insonify::decode::read_geotiff(read("own.tif")),
             local = insonify::decode::read_geotiff(read("local.tif"));
  EXPECT_EQ(own.epsg, 25832);
  EXPECT_EQ(own.west, local.west);
  EXPECT_EQ(own.north, local.north);
  ASSERT_EQ(own.bands.size(), local.bands.size());
  for (std::size_t k = 0; k < own.bands.size(); ++k)
    EXPECT_THAT(own.bands[k], testing::Pointwise(testing::NanSensitiveFloatEq(), local.bands[k]));
  // ETRS89 and WGS 84 agree to a metre: the position of easting and northing by the equations of UTM.
  succeed("export out --to geotiff --cell 0.5 --crs EPSG:32632 -q -o utm.tif");
  EXPECT_NEAR(insonify::decode::read_geotiff(read("utm.tif")).west, own.west, 1.5);
}

// The plane of LAS is that of the world, so x and y are the columns of the table.
TEST_F(ProjectedWorld, las_and_tables_have_its_coordinates) {
  if (!with_gdal) GTEST_SKIP() << "built without GDAL";
  ping("etrs.asc", "out");
  for (const std::string version : {"1.4", "1.2"}) {
    succeed("export out --to las --force -q -o own.las --las-version " + version);
    succeed("export out --to csv --force -q -o own.csv");
    EXPECT_THAT(succeed("info own.las"), HasSubstr("EPSG:25832"));
    const std::vector<insonify::decode::LasRow> points = insonify::decode::read_las(read("own.las"));
    std::istringstream lines(read("own.csv"));
    std::string line;
    std::getline(lines, line);
    EXPECT_THAT(line, testing::EndsWith(",latitude_deg,longitude_deg,easting_m,northing_m"));
    ASSERT_GT(points.size(), 20U);
    for (const insonify::decode::LasRow& point : points) {
      ASSERT_TRUE(std::getline(lines, line));
      std::vector<std::string> row;
      std::istringstream fields(line);
      for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
      EXPECT_EQ(point.beam, std::stoul(row[2]));
      for (std::size_t axis = 0; axis < 2; ++axis) {
        EXPECT_NEAR(point.position[axis], std::stod(row[3 + axis]), 1.1e-4);
        EXPECT_EQ(row[row.size() - 2 + axis], row[3 + axis]);
      }
    }
  }
}

TEST_F(ProjectedWorld, surveys_keep_it_and_refuse_what_contradicts_it) {
  if (!with_gdal) GTEST_SKIP() << "built without GDAL";
  write("m.toml", mission("bed.asc"));
  succeed("survey m.toml -q -o run");
  EXPECT_THAT(read("run/scene.json"), HasSubstr("EPSG:32632"));
  succeed("merge run --mosaic 0.5 -q");
  EXPECT_EQ(insonify::decode::read_geotiff(read("run/mosaic.tif")).epsg, 32632);
  EXPECT_THAT(read("run/manifest.json"), HasSubstr("EPSG:32632"));
  const double own_west = insonify::decode::read_geotiff(read("run/mosaic.tif")).west;
  succeed("merge run --mosaic 0.5 --crs EPSG:25832 -q");
  EXPECT_EQ(insonify::decode::read_geotiff(read("run/mosaic.tif")).epsg, 25832);
  EXPECT_NEAR(insonify::decode::read_geotiff(read("run/mosaic.tif")).west, own_west, 1.5);
  succeed("export run --to las -q -o a.las");
  succeed("export run/em2040 --to las -q -o b.las");
  EXPECT_EQ(read("a.las"), read("b.las"));
  EXPECT_THAT(succeed("info run"), testing::Not(HasSubstr("--anchor")));

  write("anchored.toml", mission("bed.asc", "anchor = { latitude_deg = 54, longitude_deg = 8 }"));
  expect_refused("survey anchored.toml -o no", 2, {"anchor", "100 km", "--utm ZONE"});
  write("other.toml", mission("bed.asc", "system = \"EPSG:32633\""));
  expect_refused("survey other.toml -o no", 3, {"EPSG:32633", "the scene is in EPSG:32632"});
  write("both.toml", mission("bed.asc", "system = \"EPSG:32632\"\nanchor = { latitude_deg = 54, longitude_deg = 8 }"));
  expect_refused("survey both.toml -o no", 3, {"anchor", "system", "leave one out"});
  EXPECT_FALSE(std::filesystem::exists(path("no")));
}

// A ball on the bed, 4 m to port of a side-scan, is the brightest place of the mosaic: to its radius and
// a cell where it lies in the system.
TEST_F(ProjectedWorld, a_bright_target_lies_in_the_mosaic_where_it_is) {
  if (!with_gdal) GTEST_SKIP() << "built without GDAL";
  constexpr double east = west + 6, north = south + 10, cell = 0.25;
  succeed("make-object sphere --set diameter_m=0.3 -q -o ball.ply");
  write("parts.toml", fmt::format("schema = 1\n[[part]]\nfile = \"bed.asc\"\n[[part]]\nfile = \"ball.ply\"\n"
                                  "position_m = [{}, {}, -4.9]\n",
                                  east, north));
  write("m.toml", text_of({.scene = "parts.toml",
                           .way = fmt::format("[{}, {}, -2], [{}, {}, -2]", west + 5, south + 6, west + 7, south + 6),
                           .sonar = "starfish-450",
                           .range = "1:8",
                           .head = "rate_hz = 5"}));
  succeed("survey m.toml -q -o run");
  succeed("merge run --mosaic 0.25 -q");
  const insonify::decode::GeotiffContent map = insonify::decode::read_geotiff(read("run/mosaic.tif"));
  EXPECT_EQ(map.epsg, 32632);
  const std::vector<float>& strength = map.bands.at(0);
  std::size_t best = 0;
  for (std::size_t i = 1; i < strength.size(); ++i)
    if (std::isnan(strength[best]) || strength[i] > strength[best]) best = i;
  EXPECT_NEAR(map.west + (static_cast<double>(best % map.columns) + 0.5) * map.cell, east, 0.15 + cell);
  EXPECT_NEAR(map.north - (static_cast<double>(best / map.columns) + 0.5) * map.cell, north, 0.15 + cell);
}

TEST_F(ProjectedWorld, missions_state_it_for_a_scene_that_does_not) {
  write("m.toml", mission("none.asc", "system = \"EPSG:32632\""));
  succeed("survey m.toml -q -o run");
  succeed("merge run --mosaic 0.5 -q");
  EXPECT_EQ(insonify::decode::read_geotiff(read("run/mosaic.tif")).epsg, 32632);
  succeed("export run --to gsf -q -o a.gsf");
  expect_refused("export run --to gsf --utm 12S -o no.gsf", 2, {"--utm 12S is EPSG:32712", "EPSG:32632"});
}

TEST_F(ProjectedWorld, anchors_are_for_worlds_with_an_origin_of_their_own) {
  ping("none.asc", "out");
  expect_refused("export out --to gsf --anchor 54,8,0 -o no.gsf", 2,
                 {"--anchor", "5921 km from its origin", "--utm ZONE", "--system EPSG:N"});
  expect_refused("export out --to gsf --utm 12T -o no.gsf", 2, {"T is a band of MGRS", "zone 12N"});
  EXPECT_THAT(run("export out --to gsf --utm 12S -o south.gsf").err, HasSubstr("south of the equator (EPSG:32712)"));
}
