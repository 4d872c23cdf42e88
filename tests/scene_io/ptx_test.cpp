// SPDX-License-Identifier: BSD-3-Clause
// PTX and PTS: the text of laser scanners. The files are written here, from their description.
#include <cmath>
#include <random>

#include <gmock/gmock.h>

#include "core/units.hpp"
#include "sampling/find_scatterers.hpp"
#include "scene_io/describe_file.hpp"
#include "scene_io/load_scene.hpp"
#include "scene_io/test_files.hpp"
#include "support/files.hpp"

namespace insonify::ptx_tests {

using Eigen::Vector3d;
using testing::HasSubstr;

std::string line_of(const Vector3d& v) {
  std::ostringstream out;
  out.precision(12);
  out << v.x() << " " << v.y() << " " << v.z();
  return out.str();
}

// Returns the header of a scan: numbers, place and axes of the scanner, and the matrix of points as rows.
std::string header(int columns, int rows, const Pose& scanner) {
  std::string text =
      std::to_string(columns) + "\n" + std::to_string(rows) + "\n" + line_of(scanner.translation()) + "\n";
  for (int k = 0; k < 3; ++k) text += line_of(scanner.linear().col(k)) + "\n";
  for (int k = 0; k < 3; ++k) text += line_of(scanner.linear().col(k)) + " 0\n";
  return text + line_of(scanner.translation()) + " 1\n";
}

Pose scanner_at(const Vector3d& position, double turn) {
  Pose pose = Pose::Identity();
  pose.rotate(Eigen::AngleAxisd(turn, Vector3d::UnitZ()) * Eigen::AngleAxisd(0.1, Vector3d::UnitX()));
  pose.pretranslate(position);
  return pose;
}

// Returns the range from a position to a floor at z = -2, a ball and a wall at x = 9, along a unit vector; 0: none.
double range_from(const Vector3d& from, const Vector3d& d) {
  double range = d.z() < 0 ? (-2 - from.z()) / d.z() : 1e9;
  if (d.x() > 0) range = std::min(range, (9 - from.x()) / d.x());
  const Vector3d ball = Vector3d(5, 1, -1) - from;
  const double b = ball.dot(d), left = b * b - ball.squaredNorm() + 0.64;
  if (left > 0 && b > 0) range = std::min(range, b - std::sqrt(left));
  return range < 40 ? range : 0;
}

// Returns a scan in steps of half a degree, in the axes of the scanner, with `noise` along the line of sight [m].
std::string scan_from(const Pose& scanner, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::string text = header(160, 80, scanner);
  for (int i = -80; i < 80; ++i)
    for (int j = -70; j < 10; ++j) {
      const Vector3d d = unit_vector({radians(0.5 * i), radians(0.5 * j)});
      const double range = range_from(scanner.translation(), scanner.linear() * d);
      const bool hole = range == 0 || (i + j) % 17 == 0;
      text += (hole ? "0 0 0 0.5" : line_of((range + noise * normal(random)) * d) + " 0.25") + "\n";
    }
  return text;
}

// Returns the share of the surfels of a station, by their ids, that a head at its position sees, and the share of the
// energy that comes from them [dB].
std::pair<double, double> seen_again(const SceneCloud& scene, const Pose& from, std::size_t begin, std::size_t end) {
  const BeamFan fan = make_fan(64, radians(70), radians(1.5), radians(60));
  SamplingOptions options{.scatterers_per_cell = 0, .elevation_half_extent = radians(40)};
  const auto energy = [&] {
    const Scatterers s = find_scatterers(scene, from, fan, {0.1, 30, 0.05}, options).scatterers;
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const std::uint32_t id = scene.id[s.surfel[i]];
      if (id < begin || id >= end) continue;
      sum += s.projected_area[i] * s.cos_incidence[i] / std::pow(s.range[i], 4), ++count;
    }
    return std::pair(count, sum);
  };
  const auto seen = energy();
  options.occlusion = false;
  const auto all = energy();
  return {seen.first / all.first, db_from_power(seen.second / all.second)};
}

TEST(PtxFile, one_scan_is_an_organised_cloud_with_its_viewpoint) {
  const Pose scanner = scanner_at({1, 0.5, 0.25}, 0.3);
  own_file("one.ptx", scan_from(scanner, 0, 1));
  const FileDescription d = describe_file(own_path("one.ptx"));
  EXPECT_EQ(d.width, 80u);
  EXPECT_EQ(d.height, 160u);
  EXPECT_EQ(d.points, 12800u);
  ASSERT_TRUE(d.viewpoint);
  EXPECT_TRUE(d.viewpoint->isApprox(scanner.translation(), 1e-9));

  const LoadedScene loaded = load_scene(own_path("one.ptx"));
  EXPECT_EQ(loaded.report.other_columns, std::vector<std::string>{"intensity"});
  EXPECT_EQ(loaded.report.dropped_not_finite, d.not_finite);
  EXPECT_TRUE(loaded.scene.normals_oriented);
  std::size_t off = 0;
  for (const Eigen::Vector3f& p : loaded.scene.point) {
    const Vector3d way = loaded.scene.origin + p.cast<double>() - scanner.translation();
    off += std::abs(range_from(scanner.translation(), way.normalized()) - way.norm()) > 1e-5;
  }
  EXPECT_EQ(off, 0u);
}

// A vehicle's yaw turns a head, but a scanner at the same position saw the same: nothing may hide anything.
TEST(PtxFile, of_two_stations_is_whole_from_each_of_them) {
  const Pose left = scanner_at({0, 0, 0}, 0.1), right = scanner_at({1, 3.5, 0.5}, -0.3);
  own_file("two.ptx", scan_from(left, 0.03, 1) + scan_from(right, 0.03, 2));
  const FileDescription d = describe_file(own_path("two.ptx"));
  ASSERT_EQ(d.stations.size(), 2u);
  EXPECT_TRUE(d.stations[1].isApprox(right.translation(), 1e-9));
  EXPECT_EQ(d.height, 1u);

  const LoadedScene loaded = load_scene(own_path("two.ptx"));
  EXPECT_THAT(loaded.report.notes,
              testing::Contains(HasSubstr("2 scans: each point was seen from the scanner of its own")));
  for (const bool first : {true, false}) {
    const auto [share, lost_db] =
        seen_again(loaded.scene, first ? left : right, first ? 0 : 12800, first ? 12800 : 25600);
    EXPECT_GT(share, 0.999) << first;
    EXPECT_GT(lost_db, -0.01) << first;
  }
  // Points of both stations look at their own.
  const SceneCloud& scene = loaded.scene;
  std::size_t away = 0;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const bool from_left = scene.id[i] < 12800;
    const Vector3d seen = (from_left ? left : right).translation() - scene.origin - scene.point[i].cast<double>();
    away += seen.dot(scene.normal[i].cast<double>()) <= 0;
  }
  EXPECT_EQ(away, 0u);
  // Areas: where both stations see the floor, its area counts once.
  double floor = 0;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Vector3d p = scene.origin + scene.point[i].cast<double>();
    if (p.z() < -1.8 && p.x() > 5.2 && p.x() < 7.2 && p.y() > -1.2 && p.y() < 0.3) floor += scene.area[i];
  }
  EXPECT_NEAR(floor, 3, 0.3);
}

TEST(PtxFile, takes_the_place_of_the_scanner_from_the_header_or_from_the_matrix) {
  const std::string points = "1 0 0 0.5\n1 1 0 0.5\n1 0 1 0.5\n1 1 1 0.5\n", unposed = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n",
                    identity = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  const auto viewpoint = [&](const std::string& text) {
    own_file("place.ptx", "2\n2\n" + text + points);
    return describe_file(own_path("place.ptx")).viewpoint.value();
  };
  EXPECT_EQ(viewpoint(unposed + "1 0 0 0\n0 1 0 0\n0 0 1 0\n500000 4 5 1\n"), Vector3d(500000, 4, 5));
  EXPECT_EQ(viewpoint("7 8 9\n1 0 0\n0 1 0\n0 0 1\n" + identity), Vector3d(7, 8, 9));
  EXPECT_EQ(viewpoint(unposed + identity), Vector3d(0, 0, 0));
}

TEST(PtxFile, damage_is_named_with_its_line) {
  const std::string whole = header(2, 2, scanner_at({1, 0, 0}, 0)) + "1 0 0 0.5\n1 1 0 0.5\n1 0 1 0.5\n1 1 1 0.5\n";
  const auto refusal = [&](std::string text, const std::vector<std::string>& words) {
    own_file("bad.ptx", text);
    expect_error(ErrorKind::content, words, [] { load_scene(own_path("bad.ptx")); });
  };
  refusal(whole.substr(0, whole.size() - 10), {"bad.ptx", "cut off after line 13"});
  refusal("x\n" + whole, {"bad.ptx:1", "number of columns", "'x'"});
  refusal("2\n0\n", {"bad.ptx:2", "number of rows"});
  refusal("4294967295\n4294967295\n", {"bad.ptx:2", "must be at most 4294967296"});
  refusal(whole + "2\n2\n0 0 0\n2 0 0\n0 2 0\n0 0 2\n" + whole.substr(whole.find("1 0 0 0\n")),
          {"bad.ptx", "no rotation"});
  std::string text = whole;
  refusal(text.replace(text.rfind("1 1 0 0.5"), 9, "1 1 0"), {"bad.ptx:12", "expected 4 numbers, found 3"});
  refusal("\n", {"bad.ptx", "no scan"});
}

TEST(PtsFile, has_intensity_and_colour_by_the_number_of_its_columns) {
  own_file("four.pts", "2\n0 0 0 -1300\n1 0 0 -1200\n");
  own_file("seven.pts", "2\n0 0 0 -1300 1 2 3\n1 0 0 -1200 1 2 3\n2\n0 1 0 -1300 1 2 3\n1 1 0 -1200 1 2 3\n");
  own_file("six.pts", "0 0 0 0 1 0\n1 0 0 1 0 0\n");  // colours, although they look like normals
  const auto names = [](const std::string& file) {
    std::string all;
    for (const auto& field : describe_file(own_path(file)).fields) all += field.name + " ";
    return all;
  };
  EXPECT_EQ(names("four.pts"), "x y z intensity ");
  EXPECT_EQ(names("seven.pts"), "x y z intensity red green blue ");
  EXPECT_EQ(names("six.pts"), "x y z red green blue ");
  EXPECT_EQ(describe_file(own_path("seven.pts")).points, 4u);
  own_file("cut.pts", "3\n0 0 0 -1300\n1 0 0 -1200\n");
  expect_error(ErrorKind::content, {"cut.pts", "announces 3 points, found 2"}, [] { load_scene(own_path("cut.pts")); });
}

}  // namespace insonify::ptx_tests
