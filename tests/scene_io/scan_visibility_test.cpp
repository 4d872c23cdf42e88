// SPDX-License-Identifier: BSD-3-Clause
// Tests that a scan, seen whole by its scanner, is seen whole when pinged from there.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/units.hpp"
#include "sampling/find_scatterers.hpp"
#include "scene_io/load_scene.hpp"
#include "scene_io/test_files.hpp"
#include "support/files.hpp"

using namespace insonify;

namespace {

// Returns ranges of a wall, a sphere before it and a post, for a head that looks along +x, 2 m above a floor.
double true_range(const Eigen::Vector3d& d) {
  double range = d.z() < 0 ? -2 / d.z() : 1e9;
  range = std::min(range, 9 / d.x());
  const Eigen::Vector3d ball(5, 1, -1), post(4, -1.2, 0);
  const double b = ball.dot(d), left = b * b - ball.squaredNorm() + 0.64;
  if (left > 0) range = std::min(range, b - std::sqrt(left));
  const Eigen::Vector2d across = d.head<2>();
  const double c = post.head<2>().dot(across) / across.squaredNorm(), miss = (c * across - post.head<2>()).norm();
  if (miss < 0.1) range = std::min(range, c - std::sqrt(0.01 - miss * miss) / across.norm());
  return range;
}

struct Scan {
  std::string text;
  std::size_t points = 0;
};

// Returns a scan with steps of 0.5 degrees; quantum: steps of the range [m].
Scan scan(double noise, double quantum = 0) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::ostringstream out;
  Scan s;
  for (int i = -60; i < 12; ++i)
    for (int j = -70; j < 70; ++j, ++s.points) {
      const Eigen::Vector3d d = unit_vector({radians(0.5 * j), radians(0.5 * i)});
      double range = true_range(d) + noise * normal(random);
      if (quantum > 0) range = quantum * std::round(range / quantum);
      out << (range * d).transpose() << "\n";
    }
  s.text = out.str();
  return s;
}

struct Seen {
  double surfels, energy_db;
};

Seen seen_from_scanner(const SceneCloud& scene) {
  const BeamFan fan = make_fan(64, radians(80), radians(1.5), radians(70));
  SamplingOptions options{.scatterers_per_cell = 0, .elevation_half_extent = radians(45)};
  const auto energy = [&] {
    const Scatterers s = find_scatterers(scene, Pose::Identity(), fan, {0.1, 30, 0.05}, options).scatterers;
    double sum = 0;
    for (std::size_t i = 0; i < s.size(); ++i)
      sum += s.projected_area[i] * s.cos_incidence[i] / std::pow(s.range[i], 4);
    return std::pair(static_cast<double>(s.size()), sum);
  };
  const auto seen = energy();
  options.occlusion = false;
  const auto all = energy();
  return {seen.first / all.first, db_from_power(seen.second / all.second)};
}

SceneCloud loaded(const std::string& name) {
  LoadOptions options;
  options.viewpoint = Eigen::Vector3d::Zero();
  return load_scene(own_path(name), options).scene;
}

}  // namespace

TEST(ScanVisibility, of_a_noisy_scan_from_its_own_viewpoint_is_98_percent_and_0_2_db) {
  for (const double noise : {0.0, 0.01, 0.02, 0.04}) {
    own_file("scan.xyz", scan(noise).text);
    const Seen seen = seen_from_scanner(loaded("scan.xyz"));
    EXPECT_GT(seen.surfels, 0.98) << noise;
    EXPECT_GT(seen.energy_db, -0.2) << noise;
  }
}

// Ranges in steps of several spacings, as a stereo camera gives them: lines of sight of an organised cloud are proof.
TEST(ScanVisibility, of_an_organised_scan_in_steps_is_whole_from_its_own_viewpoint) {
  const Scan s = scan(0.1, 0.2);
  own_file("scan.pcd",
           "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 140\nHEIGHT 72\n"
           "VIEWPOINT 0 0 0 0 1 0 0\nPOINTS " +
               std::to_string(s.points) + "\nDATA ascii\n" + s.text);
  const Seen seen = seen_from_scanner(loaded("scan.pcd"));
  EXPECT_GT(seen.surfels, 0.999);
  EXPECT_GT(seen.energy_db, -0.01);
}

TEST(ScanVisibility, takes_noise_from_the_file_else_from_the_options) {
  own_file("scan.xyz", scan(0.02).text);
  LoadOptions options;
  options.scan_noise = 0.03;
  const LoadedScene given = load_scene(own_path("scan.xyz"), options);
  EXPECT_FALSE(given.report.noise_estimated);
  EXPECT_EQ(given.scene.noise, std::vector<float>(given.scene.size(), 0.03f));
  own_file("noise.csv", "x,y,z,nx,ny,nz,area,noise\n0,0,0,0,0,1,1,0.5\n1,0,0,0,0,1,1,nan\n");
  EXPECT_EQ(load_scene(own_path("noise.csv"), options).scene.noise, (std::vector<float>{0.5f, 0}));
  options.scan_noise = -1;
  expect_error(ErrorKind::argument, {"scan_noise = -1 m", "must be finite and >= 0"},
               [&] { load_scene(own_path("scan.xyz"), options); });
}
