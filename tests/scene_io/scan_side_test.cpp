// SPDX-License-Identifier: BSD-3-Clause
// From which side a cloud was seen, where nobody says so: rasters of heights look up, organised scans that fan out from
// the origin of their coordinates were seen from there.
#include <cmath>

#include "core/units.hpp"
#include "sampling/find_scatterers.hpp"
#include "scene_io/describe_file.hpp"
#include "scene_io/test_files.hpp"
#include "support/height_field.hpp"

using namespace insonify;

namespace {

using Eigen::Vector3d;

/// Returns the range of a wavy floor 2 m below the origin, to a wall 9 m ahead; NaN without a surface.
double range_along(const Vector3d& d) {
  const auto below = [&](double r) {
    return r * d.z() < -2 + 0.25 * std::sin(2 * r * d.x()) * std::cos(1.7 * r * d.y());
  };
  for (double r = 1; r < 30; r += 0.01)
    if (r * d.x() > 9 || below(r)) return r;
  return std::nan("");
}

/// Returns the text of an organised PCD of so many columns and rows; `viewpoint` is a line of the header, or empty.
template <typename Position>
std::string organised(int columns, int rows, const std::string& viewpoint, Position&& position) {
  std::ostringstream text;
  text << "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " << columns << "\nHEIGHT " << rows
       << "\n"
       << viewpoint << "POINTS " << columns * rows << "\nDATA ascii\n";
  text.precision(9);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Vector3d p = position(column, row);
      text << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    }
  return text.str();
}

/// Returns a direction of a turning sonar at the origin, with steps of 0.6 degrees, and of a camera that looks 20
/// degrees down.
Vector3d turning(int column, int row) {
  const Vector3d d = unit_vector({radians(0.6 * (column - 50)), radians(0.6 * (row - 60))});
  return range_along(d) * d;
}
Vector3d pictured(int column, int row) {
  const Pose tilted = pose_from_yaw_pitch_roll({0, 0, 0}, 0.3, radians(20), 0.1);
  const Vector3d d = tilted.linear() * Vector3d(1, 0.012 * (column - 50), 0.012 * (row - 35)).normalized();
  return range_along(d) * d;
}
constexpr int scan_columns = 100, scan_rows = 70;

double seen_from_origin(const SceneCloud& scene) {
  const BeamFan fan = make_fan(64, radians(70), radians(1.5), radians(70));
  SamplingOptions options{.scatterers_per_cell = 0, .elevation_half_extent = radians(60)};
  const auto seen = [&] {
    return static_cast<double>(
        find_scatterers(scene, Pose::Identity(), fan, {0.1, 30, 0.05}, options).scatterers.size());
  };
  const double part = seen();
  options.occlusion = false;
  options.footprint = 1.2;
  SceneCloud both_sides = scene;
  both_sides.normals_oriented = false;
  return part / static_cast<double>(
                    find_scatterers(both_sides, Pose::Identity(), fan, {0.1, 30, 0.05}, options).scatterers.size());
}

bool described(const std::string& path, const std::string& part) {
  const FileDescription file = describe_file(path);
  return std::any_of(file.problems.begin(), file.problems.end(),
                     [&](const std::string& problem) { return problem.find(part) != std::string::npos; });
}

}  // namespace

TEST(ScanSide, of_an_organised_scan_is_that_of_the_origin_that_it_fans_out_from) {
  int scans = 0;
  for (const auto& position : {turning, pictured}) {
    const std::string path =
        own_file("scan.pcd", organised(scan_columns, scan_rows, "VIEWPOINT 0 0 0 1 0 0 0\n", position));
    const LoadedScene found = load_scene(path);
    ASSERT_TRUE(found.report.viewpoint) << scans;
    EXPECT_EQ(*found.report.viewpoint, Vector3d::Zero());
    EXPECT_TRUE(has_note(found.report, "fan out from 0,0,0"));
    EXPECT_TRUE(described(path, "fan out from 0,0,0"));
    EXPECT_EQ(describe_file(path).viewpoint, std::optional<Vector3d>(Vector3d::Zero()));
    LoadOptions given;
    given.viewpoint = Vector3d::Zero();
    const LoadedScene known = load_scene(path, given);
    EXPECT_TRUE(found.scene.normals_oriented);
    EXPECT_EQ(found.scene.normal, known.scene.normal);
    EXPECT_EQ(found.scene.area, known.scene.area);
    EXPECT_EQ(found.scene.noise, known.scene.noise);
    EXPECT_FALSE(has_note(known.report, "fan out"));
    EXPECT_GE(seen_from_origin(found.scene), 0.995) << scans;
    ++scans;
  }
  EXPECT_EQ(scans, 2);
}

// The points are the same, but the scanner stood elsewhere, or nobody knows: then both sides reflect, as the note says.
TEST(ScanSide, stays_unknown_where_rows_do_not_fan_out_from_the_origin) {
  const auto elsewhere = [](int column, int row) -> Vector3d { return turning(column, row) + Vector3d(3, 1, -2); };
  const auto raster_turned = [](int column, int row) -> Vector3d {
    const double x = 0.05 * column, y = 0.05 * row;
    return {8 + 0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, -2 + 0.1 * std::sin(9 * x) * std::cos(7 * y)};
  };
  const auto wall = [](int column, int row) -> Vector3d { return {0.05 * column, 0.05 * row, 4}; };
  // Directions that stray by a twentieth of a step to either side, ranges by far more.
  const auto straying = [](int column, int row) -> Vector3d {
    const double stray = column % 2 == 0 ? 0.03 : -0.03;
    const Vector3d d = unit_vector({radians(0.6 * (column - 50 + stray)), radians(0.6 * (row - 60 + stray))});
    return (column / 2 % 2 == 0 ? 1 : 1.5) * range_along(d) * d;
  };
  int clouds = 0;
  for (const std::string& text :
       {organised(scan_columns, scan_rows, "", elsewhere), organised(scan_columns, scan_rows, "", raster_turned),
        organised(scan_columns, scan_rows, "", wall), organised(scan_columns, scan_rows, "", straying)}) {
    const std::string path = own_file("cloud.pcd", text);
    const LoadedScene loaded = load_scene(path);
    EXPECT_FALSE(loaded.report.viewpoint) << clouds;
    EXPECT_FALSE(loaded.scene.normals_oriented) << clouds;
    EXPECT_TRUE(has_note(loaded.report, "both sides of every surface reflect")) << clouds;
    EXPECT_TRUE(described(path, "give a viewpoint")) << clouds;
    ++clouds;
  }
  EXPECT_EQ(clouds, 4);
}

TEST(ScanSide, of_a_raster_of_heights_is_the_upper_one) {
  // Steep sides, of which some turn from any viewpoint above.
  const HeightField bed =
      height_field({3, 3}, 1.2, 0.04, [](double x, double y) { return 0.3 * std::sin(7 * x) + 0.1 * std::cos(9 * y); });
  const std::string path = own_file("bed.xyz", points_of(bed));
  EXPECT_TRUE(described(path, "looks up"));
  const LoadedScene loaded = load_scene(path);
  EXPECT_TRUE(has_note(loaded.report, "looks up"));
  EXPECT_TRUE(loaded.scene.normals_oriented);
  for (const Eigen::Vector3f& normal : loaded.scene.normal) ASSERT_GE(normal.z(), 0);
  ASSERT_TRUE(loaded.mesh);
  EXPECT_TRUE(loaded.mesh->normals_oriented);
  for (std::size_t t = 0; t < loaded.mesh->triangle.size(); ++t) {
    const auto [a, b, c] = corners_of(*loaded.mesh, t);
    ASSERT_GT((b - a).cross(c - a).z(), 0);
  }
  // Sampled as points it is seen from above, too, or from below if the capture stood there.
  LoadOptions options;
  options.mesh_spacing = 0.04;
  EXPECT_TRUE(load_scene(path, options).scene.normals_oriented);
  options = {};
  options.viewpoint = Vector3d(3, 3, -50);
  const LoadedScene below = load_scene(path, options);
  EXPECT_FALSE(has_note(below.report, "looks up"));
  for (const Eigen::Vector3f& normal : below.scene.normal) ASSERT_LE(normal.z(), 0);
}
