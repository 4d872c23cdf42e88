// SPDX-License-Identifier: BSD-3-Clause
// Clouds as they come from files: holes, uneven density, map coordinates, no materials; and pings of them.
#include "scene_io/load_scene.hpp"
#include "support/checked_ping.hpp"

namespace insonify::loaded_clouds {

/// Returns rows "x y z nx ny nz" of a plate at x = 5 + east that faces the head, 2 m square.
std::string plate_rows(int n, double east = 0, double north = 0) {
  std::ostringstream text;
  text.precision(12);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      text << 5 + east << ' ' << north - 1 + (i + 0.5) * 2 / n << ' ' << -1 + (j + 0.5) * 2 / n << " -1 0 0\n";
  return text.str();
}

LoadedScene load_rows(const std::string& rows) {
  const std::string path = own_file("in.txt", "x y z nx ny nz\n" + rows);
  return load_scene(path);
}

// Half of a plate sampled k^2 times as densely as the other: its sum of cross-sections must not follow.
TEST(LoadedClouds, cross_section_follows_the_area_and_not_the_density) {
  for (const int k : {1, 2, 3}) {
    std::ostringstream rows;
    const auto half = [&rows](double left, double step) {
      for (int i = 0; i < std::lround(1 / step); ++i)
        for (int j = 0; j < std::lround(2 / step); ++j)
          rows << "5 " << left + (i + 0.5) * step << ' ' << -1 + (j + 0.5) * step << " -1 0 0\n";
    };
    half(-1, 0.1);
    half(0, 0.1 / k);
    const SceneCloud scene = load_rows(rows.str()).scene;
    double sparse = 0, dense = 0;
    for (std::size_t i = 0; i < scene.size(); ++i)
      (scene.origin.y() + scene.point[i].y() < 0 ? sparse : dense) += scene.area[i];
    EXPECT_NEAR(dense, 2, 0.12) << k;
    EXPECT_NEAR(sparse, 2, 0.12) << k;
  }
}

TEST(LoadedClouds, holes_of_an_organised_cloud_are_dropped_and_counted) {
  std::string rows;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 8; ++j)
      rows +=
          (i * j) % 5 == 4 ? "nan nan nan\n" : "5 " + std::to_string(0.1 * i) + " " + std::to_string(0.1 * j) + "\n";
  const std::string path =
      own_file("in.pcd",
               "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 8\n"
               "HEIGHT 6\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 48\nDATA ascii\n" +
                   rows);
  const LoadedScene loaded = load_scene(path);
  EXPECT_EQ(loaded.report.points_read, 48U);
  EXPECT_EQ(loaded.report.dropped_not_finite, 6U);
  EXPECT_EQ(loaded.scene.size(), 42U);
  EXPECT_TRUE(all_finite(ping_of(loaded.scene)));
}

TEST(LoadedClouds, cloud_without_materials_gets_the_default_and_says_so) {
  const LoadedScene loaded = load_rows(plate_rows(10));
  EXPECT_FALSE(loaded.report.materials_found);
  ASSERT_EQ(loaded.scene.materials.size(), 1U);
  EXPECT_NEAR(db_from_power(loaded.scene.materials[0].lambert_mu), -27, 1e-9);
}

}  // namespace insonify::loaded_clouds
