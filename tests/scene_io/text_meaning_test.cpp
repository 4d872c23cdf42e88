// SPDX-License-Identifier: BSD-3-Clause
// Text as survey software, CloudCompare, PDAL and COLMAP write it: headings, units, depths, decimals.
#include <cstdlib>

#include "core/geodesy.hpp"
#include "scene_io/describe_file.hpp"
#include "scene_io/test_files.hpp"

namespace {

/// Returns places of a bed at -12 m and below [m], exact in six decimals.
std::vector<Eigen::Vector3d> survey_bed() {
  std::vector<Eigen::Vector3d> all;
  for (int i = 0; i < 64; ++i)
    all.emplace_back(500000 + 0.25 * (i % 8), 6000000 + 0.25 * (i / 8), -12 - 0.015625 * ((5 * i) % 16));
  return all;
}

/// A program's way to write the bed.
struct Spelling {
  std::string heading, delimiter = ",";
  Eigen::Vector3d factor = {1, 1, 1};   ///< units of the file per metre; below 0 for depths
  std::array<int, 3> axis = {0, 1, 2};  ///< axis of each column
  char decimal = '.';
  std::string behind = "", quote = "", sign = "";
};

std::string written(const Spelling& how) {
  std::string text = how.heading.empty() ? "" : how.heading + "\n";
  for (const Eigen::Vector3d& p : survey_bed()) {
    for (int k = 0; k < 3; ++k) {
      const int axis = how.axis[static_cast<std::size_t>(k)];
      char number[64];
      std::snprintf(number, sizeof number, "%.9f", p[axis] * how.factor[axis]);
      std::string cell = number;
      std::replace(cell.begin(), cell.end(), '.', how.decimal);
      text += (k > 0 ? how.delimiter : "") + how.quote + (cell.front() == '-' ? "" : how.sign) + cell + how.quote;
    }
    text += how.behind + "\n";
  }
  return text;
}

void expect_bed(const LoadedScene& loaded, const std::string& what) {
  ASSERT_EQ(loaded.scene.size(), 64u) << what;
  for (std::size_t i = 0; i < 64; ++i) EXPECT_LT((world(loaded.scene, i) - survey_bed()[i]).norm(), 1e-6) << what << i;
}

std::string output_of(const std::string& command) {
  const std::string line = "cd '" + own_folder() + "' && (" + command + ") >said.txt 2>&1";
  return std::system(line.c_str()) == 0 ? file_bytes(own_path("said.txt")) : "";
}

}  // namespace

TEST(TextMeaning, headings_of_other_programs_name_the_coordinates) {
  const std::vector<Spelling> spellings = {
      {"Easting,Northing,Depth", ",", {1, 1, -1}},
      {"Northing;Easting;Height", ";", {1, 1, 1}, {1, 0, 2}},
      {"X [m],Y [m],Z [m]"},
      {"X(m)\tY(m)\tZ(m)", "\t"},
      {"X [m] Y [m] Z [m]", " "},
      {"x,y,depth", ",", {1, 1, -1}},
      {"//X,Y,Z"},
      {"\"Easting (m)\",\"Northing (m)\",\"Depth (m, positive down)\"", ",", {1, 1, -1}},
      {"East North Elevation Quality", " ", {1, 1, 1}, {0, 1, 2}, '.', " 7"},
      {"X;Y;Z", ";", {1, 1, 1}, {0, 1, 2}, ','},
      {"X;Y;Z", ";", {1, 1, 1}, {0, 1, 2}, ',', "", "\""},
      {"X,Y,Z", ",", {1, 1, 1}, {0, 1, 2}, ',', "", "\""},
      {"X\tY\tZ", "\t", {1, 1, 1}, {0, 1, 2}, ','},
      {"", "\t", {1, 1, 1}, {0, 1, 2}, ','},
      {"", ";", {1, 1, 1}, {0, 1, 2}, ',', ";"},
      {"", " ", {1, 1, 1}, {0, 1, 2}, '.', "D+00"},
      {"", ",", {1, 1, 1}, {0, 1, 2}, '.', "d0", "", "+"},
      {"64", " "},
      {"//X Y Z\n64", " "},
      {"% x y z", " "},
      {"x,y,z,", ",", {1, 1, 1}, {0, 1, 2}, '.', ",5"},
      {"x,y,z,a \"b,c", ",", {1, 1, 1}, {0, 1, 2}, '.', ",5,6"},
      {"x_mm,y_mm,z_mm", ",", {1e3, 1e3, 1e3}},
      {"X [ft];Y [ft];Z [ft]", ";", {1 / 0.3048, 1 / 0.3048, 1 / 0.3048}},
      {"X [US survey foot],Y [US survey foot],Z [m]", ",", {3937 / 1200.0, 3937 / 1200.0, 1}},
      {"Easting (ftUS),Northing (ftUS),Depth", ",", {3937 / 1200.0, 3937 / 1200.0, -3937 / 1200.0}},
      {"X [mm],Y,Z", ",", {1e3, 1e3, 1e3}},
      {"x,y,depth_cm", ",", {1, 1, -100}}};
  for (const Spelling& how : spellings) {
    const std::string path = own_file("a.csv", written(how));
    const LoadedScene loaded = load_scene(path);
    expect_bed(loaded, how.heading);
    EXPECT_EQ(has_note(loaded.report, "the heights are called depths"), how.factor.z() < 0) << how.heading;
    EXPECT_EQ(has_note(loaded.report, "commas within numbers"), how.decimal == ',') << how.heading;
    EXPECT_EQ(has_note(loaded.report, "become metres"), std::abs(how.factor.z()) != 1 || how.factor.x() != 1)
        << how.heading;
  }
  const std::string first = own_file("a.xyz", "64\n" + written({"", " "}) + "64\n" + written({"", " "}));
  EXPECT_EQ(load_scene(first).report.dropped_duplicates, 64u) << "two scans of a PTS file";
}

TEST(TextMeaning, what_the_caller_says_overrides_headings) {
  const std::string path = own_file("a.csv", written({"X [ft],Y [ft],Depth [ft]", ",", {1, 1, -1}}));
  LoadOptions options;
  options.meaning = meaning_override("unit", "m");
  expect_bed(load_scene(path, options), "metres after all");
  options.meaning = meaning_override("z", "up");
  options.meaning.unit = 1;
  EXPECT_NEAR(world(load_scene(path, options).scene, 0).z(), 12, 1e-6);
  // Depths that are negative are heights.
  expect_bed(load_scene(own_file("b.csv", written({"x,y,depth"}))), "negative depths");
}

TEST(TextMeaning, a_heading_without_coordinates_is_refused_by_name) {
  const auto refused = [](const std::string& heading, const std::vector<std::string>& parts) {
    expect_error(ErrorKind::content, parts, [&] { load_scene(own_file("a.csv", written({heading}))); });
  };
  refused("Easting,Northing,Kind", {"a.csv:1:", "'Easting Northing Kind'", "z may also be called", "depth"});
  refused("A,B,C", {"a.csv:1:", "'A B C'", "x may also be called", "easting"});
  refused("X [m],Y [ft],Z [m]", {"a.csv", "'X [m]'", "'Y [ft]'", "differ in unit"});
  refused("x,y,z\nm,m,m", {"a.csv:2:", "'m' in 'm,m,m'", "not a number"});
  refused("x,y,z,a,b", {"a.csv:2:", "expected 5 columns", "found 3"});
  EXPECT_TRUE(
      has_note(load_scene(own_file("b.csv", written({"X [px],Y [px],Z [px]"}))).report, "not name a known unit"));
}

// The command of the message is run where GDAL's programs are installed.
TEST(TextMeaning, degrees_are_refused_with_a_command_that_projects_them) {
  std::string text = "Lat,Lon,Depth\n";
  for (int i = 0; i < 64; ++i)
    text += std::to_string(54.1 + 1e-5 * (i / 8)) + "," + std::to_string(7.9 + 1e-5 * (i % 8)) + ",12.5\n";
  const std::string path = own_file("in.csv", text);
  const std::string said = error_of([&] { load_scene(path); }, ErrorKind::content);
  EXPECT_THAT(said, HasSubstr("'lon' and 'lat' are degrees"));
  EXPECT_THAT(said, HasSubstr("EPSG:32632"));
  for (const char* heading : {"longitude;latitude;z", "x [deg];y [deg];z", "Lon_deg;Lat_deg;z"})
    expect_error(ErrorKind::content, {"are degrees"}, [&] {
      load_scene(own_file("d.csv", heading + std::string("\n7.9;54.1;-3\n7.9001;54.1;-3\n7.9;54.1001;-3\n")));
    });
  LoadOptions options;
  options.meaning = meaning_override("unit", "m");
  EXPECT_EQ(load_scene(path, options).scene.size(), 64u) << "the caller knows better";
  if (output_of("command -v gdaltransform").empty()) GTEST_SKIP() << "gdal-bin is not installed";
  const std::size_t begin = said.find("awk"), end = said.find(", and give --z down");
  ASSERT_TRUE(begin < end && end < said.size()) << said;
  output_of(said.substr(begin, end - begin));
  options.meaning = meaning_override("z", "down");
  const LoadedScene loaded = load_scene(own_path("out.xyz"), options);
  ASSERT_EQ(loaded.scene.size(), 64u);
  const UtmPosition first = utm_position_of({radians(54.1), radians(7.9), 0}, {32, true});
  EXPECT_LT((world(loaded.scene, 0) - Eigen::Vector3d(first.easting, first.northing, -12.5)).norm(), 1e-3);
}

TEST(TextMeaning, points_of_colmap_are_read_with_tracks_of_any_length) {
  std::string text =
      "# 3D point list with one line of data per point:\n"
      "#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n"
      "# Number of points: 64, mean track length: 3.2\n";
  for (std::size_t i = 0; i < 64; ++i) {
    std::ostringstream line;
    line.precision(12);
    line << 1000 - i << ' ' << survey_bed()[i].transpose() << " 120 130 140 0.5";
    for (std::size_t k = 0; k <= i % 5; ++k) line << ' ' << k + 1 << ' ' << 17 * k;
    text += line.str() + "\n";
  }
  expect_bed(load_scene(own_file("points3D.txt", text)), "COLMAP");
}

TEST(TextMeaning, normals_have_the_names_of_other_programs) {
  for (const char* heading : {"x y z nx ny nz", "x y z Nx Ny Nz", "x y z NormalX NormalY NormalZ",
                              "x y z normal_x normal_y normal_z", "x y z Scalar_Nx scalar_Ny scalar_Nz"}) {
    std::string text = heading + std::string("\n");
    for (int i = 0; i < 64; ++i)
      text += std::to_string(0.1 * (i % 8)) + " " + std::to_string(0.1 * (i / 8)) + " 0 0.6 0 -0.8\n";
    const LoadedScene loaded = load_scene(own_file("a.xyz", text));
    EXPECT_FALSE(loaded.report.normals_estimated) << heading;
    EXPECT_LT((loaded.scene.normal[9] - Eigen::Vector3f(0.6f, 0, -0.8f)).norm(), 1e-6f) << heading;
  }
}
