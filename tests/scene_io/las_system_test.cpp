// SPDX-License-Identifier: BSD-3-Clause
// Coordinate systems of LAS files: units of plane and heights, degrees, and what is left out of them.
#include <cstdlib>

#include "core/geodesy.hpp"
#include "scene_io/describe_file.hpp"
#include "scene_io/las_file.hpp"
#include "scene_io/prepare_tiles.hpp"
#include "tiles/tiled_scene.hpp"

namespace {

constexpr double survey_foot = 1200.0 / 3937, foot = 0.3048;
const std::string geographic_wkt =
    R"(GEOGCS["NAD83",DATUM["North_American_Datum_1983",SPHEROID["GRS 1980",6378137,298.257222101]],)"
    R"(PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]])";

std::string plane_wkt(const std::string& unit) {
  return R"(PROJCS["Oregon North",)" + geographic_wkt +
         R"(,PROJECTION["Lambert_Conformal_Conic_2SP"],PARAMETER["latitude_of_origin",43.6666666666667],)"
         R"(PARAMETER["central_meridian",-120.5],PARAMETER["standard_parallel_1",46],)"
         R"(PARAMETER["standard_parallel_2",44.3333333333333],PARAMETER["false_easting",8202099.7375],)"
         R"(PARAMETER["false_northing",0],)" +
         unit + "]";
}

std::string compound_wkt(const std::string& plane, const std::string& height, const std::string& axis = "UP") {
  return R"(COMPD_CS["both",)" + plane_wkt(plane) +
         R"(,VERT_CS["heights",VERT_DATUM["North American Vertical Datum 1988",2005],)" + height +
         R"(,AXIS["Gravity-related height",)" + axis + "]]]";
}

const std::string metre = R"(UNIT["metre",1])", us_ft = R"(UNIT["US survey foot",0.304800609601219])",
                  ft = R"(UNIT["foot",0.3048])", km = R"(UNIT["kilometre",1000])";

/// Returns the keys of a GeoTIFF, each with one number.
std::vector<std::string> geo_keys(const std::vector<std::pair<int, int>>& keys) {
  const auto word = [](int value) { return bytes_of(static_cast<std::uint16_t>(value)); };
  std::string body = word(1) + word(1) + word(0) + word(static_cast<int>(keys.size()));
  for (const auto& [key, value] : keys) body += word(key) + word(0) + word(1) + word(value);
  return {las_record("LASF_Projection", 34735, body)};
}

std::vector<Eigen::Vector3d> positions_in(double plane, double height) {
  std::vector<Eigen::Vector3d> all;
  for (int i = 0; i < 64; ++i)
    all.emplace_back((500 + 0.25 * (i % 8)) / plane, (1200 + 0.25 * (i / 8)) / plane,
                     (-20 + 0.0625 * (i % 5)) / height);
  return all;
}

/// A file whose numbers are in these units, and its records.
struct SystemCase {
  std::string name;
  std::vector<std::string> records;
  double plane, height;
  std::string note;
  std::string extended = "";
};

LasFile las_of(const SystemCase& with) {
  LasFile las{.minor = 4, .format = 6, .normals = true};
  las.scale = 1e-6;
  las.offset = {0, 0, 0};
  if (with.plane < 10) las.offset = positions_in(with.plane, with.height)[0];
  las.records = with.records;
  las.extended = with.extended;
  return las;
}

std::vector<std::string> wkt_records(const std::string& wkt) { return {las_record("LASF_Projection", 2112, wkt)}; }

}  // namespace

TEST(LasSystem, units_of_the_plane_and_of_heights_become_metres) {
  const std::vector<SystemCase> cases = {
      {"no system", {}, 1, 1, ""},
      {"metres", wkt_records(plane_wkt(metre)), 1, 1, ""},
      {"survey feet", wkt_records(plane_wkt(us_ft)), survey_foot, survey_foot, "so do heights"},
      {"feet, closed by a zero", wkt_records(plane_wkt(ft) + std::string(3, '\0')), foot, foot, "are in foot"},
      {"kilometres", wkt_records(plane_wkt(km)), 1000, 1000, "kilometre"},
      {"both in survey feet", wkt_records(compound_wkt(us_ft, us_ft)), survey_foot, survey_foot, "US survey foot"},
      {"survey feet, heights in metres", wkt_records(compound_wkt(us_ft, metre)), survey_foot, 1, "US survey foot"},
      {"metres, heights in feet", wkt_records(compound_wkt(metre, ft)), 1, foot, "heights in the file are in foot"},
      {"keys of a system in survey feet", geo_keys({{1024, 1}, {1025, 1}, {3072, 2263}}), survey_foot, survey_foot,
       "so do heights"},
      {"keys with heights in feet", geo_keys({{1024, 1}, {1025, 1}, {3072, 32632}, {4096, 6360}, {4099, 9003}}), 1,
       survey_foot, "heights in the file"},
      {"keys of UTM", geo_keys({{1024, 1}, {1025, 1}, {3072, 32632}}), 1, 1, ""},
      {"behind the points",
       {},
       survey_foot,
       survey_foot,
       "so do heights",
       las_record("LASF_Projection", 2112, plane_wkt(us_ft), true)},
  };
  for (const SystemCase& with : cases) {
    const std::string path = own_file("a.las", las_of(with).bytes(positions_in(with.plane, with.height)));
    const LoadedScene loaded = load_scene(path);
    ASSERT_EQ(loaded.scene.size(), 64u) << with.name;
    for (std::size_t i = 0; i < 64; ++i)
      EXPECT_LT((world(loaded.scene, i) - positions_in(1, 1)[i]).norm(), 2e-3) << with.name << i;
    EXPECT_TRUE(with.note.empty() ? !has_note(loaded.report, "become metres") : has_note(loaded.report, with.note))
        << with.name;
    PrepareTilesOptions options;
    options.whole_points = 0;
    prepare_tiles(path, own_path("a.tiles"), options);
    const Bounds box = TiledScene(own_path("a.tiles")).info().box;
    EXPECT_LT((box.min - Eigen::Vector3d(500, 1200, -20)).norm(), 3e-3) << with.name << ", in batches";
  }
}

TEST(LasSystem, has_a_name_and_its_unit_can_be_overridden) {
  const SystemCase utm{"", geo_keys({{1024, 1}, {1025, 1}, {3072, 32632}}), 1, 1, ""};
  const std::string path = own_file("a.las", las_of(utm).bytes(positions_in(1, 1)));
  const auto system_of = [](const FileDescription& file) {
    for (const MeaningItem& item : file.meaning)
      if (item.name == "system") return item.value + "|" + item.origin;
    return std::string();
  };
  EXPECT_EQ(system_of(describe_file(path)), "EPSG:32632 (WGS 84 / UTM zone 32N)|file");
  const SystemCase feet{"", wkt_records(compound_wkt(us_ft, ft)), 1, 1, ""};
  LoadOptions options;
  options.meaning = meaning_override("unit", "m");
  const LoadedScene metres = load_scene(own_file("b.las", las_of(feet).bytes(positions_in(1, 1))), options);
  EXPECT_LT((world(metres.scene, 0) - positions_in(1, 1)[0]).norm(), 2e-3);
}

TEST(LasSystem, depths_of_the_vertical_axis_are_turned) {
  std::vector<Eigen::Vector3d> positions = positions_in(1, 1);
  for (Eigen::Vector3d& p : positions) p.z() = -p.z();
  const SystemCase with{"", wkt_records(compound_wkt(metre, metre, "DOWN")), 1, 1, ""};
  const LoadedScene loaded = load_scene(own_file("a.las", las_of(with).bytes(positions)));
  EXPECT_LT((world(loaded.scene, 0) - positions_in(1, 1)[0]).norm(), 2e-3);
  EXPECT_TRUE(has_note(loaded.report, "heights count downwards by the coordinate system"));
}

TEST(LasSystem, degrees_are_refused_in_any_record_with_the_zone_to_project_to) {
  std::vector<Eigen::Vector3d> degrees;
  for (int i = 0; i < 64; ++i) degrees.emplace_back(-122.5 + 1e-5 * (i % 8), 45.5 + 1e-5 * (i / 8), -20);
  const std::vector<std::vector<std::string>> all = {wkt_records(geographic_wkt),
                                                     geo_keys({{1024, 2}, {1025, 1}, {2048, 4326}}),
                                                     geo_keys({{1024, 2}, {1025, 1}, {2048, 4269}, {2054, 9102}})};
  for (const std::vector<std::string>& records : all) {
    const std::string path = own_file("a.las", las_of({"", records, 1, 1, ""}).bytes(degrees));
    expect_error(ErrorKind::content, {"a.las", "degrees", "EPSG:32610", "gdaltransform", "--unit m"},
                 [&] { load_scene(path); });
    expect_error(ErrorKind::content, {"degrees"}, [&] { describe_file(path); });
    PrepareTilesOptions tiles;
    tiles.whole_points = 0;
    expect_error(ErrorKind::content, {"degrees"}, [&] { prepare_tiles(path, own_path("a.tiles"), tiles); });
    LoadOptions options;
    options.meaning = meaning_override("unit", "m");
    EXPECT_EQ(load_scene(path, options).scene.size(), 64u);
  }
}

// Run the command that the message proposes, on the positions as text.
TEST(LasSystem, degrees_are_projected_by_the_proposed_command) {
  if (std::system("command -v gdaltransform >/dev/null") != 0) GTEST_SKIP() << "gdal-bin is not installed";
  const std::vector<Eigen::Vector3d> degrees = {{7.9, 54.1, -20}, {7.9001, 54.1, -20}, {7.9, 54.1001, -21}};
  const std::string path = own_file("a.las", las_of({"", wkt_records(geographic_wkt), 1, 1, ""}).bytes(degrees));
  const std::string said = error_of([&] { load_scene(path); }, ErrorKind::content);
  const std::size_t begin = said.find("gdaltransform"), end = said.find("; if the numbers are metres");
  ASSERT_TRUE(begin < end && end < said.size()) << said;
  own_file("in.xyz", "7.9 54.1 -20\n7.9001 54.1 -20\n7.9 54.1001 -21\n");
  ASSERT_EQ(std::system(("cd '" + own_folder() + "' && " + said.substr(begin, end - begin)).c_str()), 0) << said;
  const LoadedScene loaded = load_scene(own_path("out.xyz"));
  ASSERT_EQ(loaded.scene.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const UtmPosition utm = utm_position_of({radians(degrees[i].y()), radians(degrees[i].x()), 0}, {32, true});
    EXPECT_LT((world(loaded.scene, i) - Eigen::Vector3d(utm.easting, utm.northing, degrees[i].z())).norm(), 1e-3);
  }
}

TEST(LasSystem, one_that_cannot_be_read_is_named) {
  for (const std::vector<std::string>& records :
       {wkt_records("rubbish"), wkt_records(""), geo_keys({}), {las_record("LASF_Projection", 34735, "abc")}}) {
    const LoadedScene loaded = load_scene(own_file("a.las", las_of({"", records, 1, 1, ""}).bytes(positions_in(1, 1))));
    EXPECT_EQ(loaded.scene.size(), 64u);
  }
  EXPECT_TRUE(has_note(load_scene(own_path("a.las")).report, "the coordinate system of the file cannot be read"));
}
