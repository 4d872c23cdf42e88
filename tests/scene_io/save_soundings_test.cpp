// SPDX-License-Identifier: BSD-3-Clause
// Returns as files: every column under its name and type, places in double.
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include "scene_io/load_scene.hpp"
#include "scene_io/save_cloud.hpp"
#include "support/test.hpp"

namespace insonify::save_soundings_tests {

Soundings some_soundings() {
  Soundings s;
  for (int i = 0; i < 20; ++i) {
    const float f = static_cast<float>(i);
    const std::uint32_t u = static_cast<std::uint32_t>(i);
    s.position.push_back({500000.125 + i, 4600000.5 - i, -i / 3.0});
    s.level_db.push_back(100.5f + f);
    s.range.push_back(5 + f / 8);
    s.azimuth.push_back(-0.5f + f / 32);
    s.elevation.push_back(0.01f * f);
    s.ping.push_back(7);
    s.beam.push_back(u * 3);
    s.bin.push_back(u * 100);
    s.true_elevation.push_back(-0.02f * f);
    s.true_surfel.push_back(u + 1000);
    s.true_material.push_back(u % 2);
  }
  return s;
}

/// Independent reader of the format of save_soundings: 3 doubles, 4 floats, 3 ints, a float, 2 ints per row.
TEST(SaveSoundings, a_ply_holds_double_coordinates_and_scalars_that_cloudcompare_knows) {
  const Soundings s = some_soundings();
  const std::string path = own_path("a.ply");
  save_soundings(path, s);
  const std::string bytes = file_bytes(path);
  const std::string expected_header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 20\nproperty double x\nproperty double "
      "y\nproperty double z\n"
      "property float scalar_level_db\nproperty float scalar_range\nproperty float scalar_azimuth\nproperty "
      "float "
      "scalar_elevation\nproperty int scalar_ping\nproperty int scalar_beam\nproperty int "
      "scalar_bin\nproperty float "
      "scalar_true_elevation\nproperty int scalar_true_surfel\nproperty int scalar_true_material\nend_header\n";
  const std::size_t end = bytes.find("end_header\n") + 11;
  std::istringstream lines(bytes.substr(0, end));
  std::string header, comments;
  for (std::string line; std::getline(lines, line);) (line.starts_with("comment") ? comments : header) += line + "\n";
  ASSERT_EQ(header, expected_header);
  for (const char* unit : {"x m", "scalar_level_db dB re 1 uPa", "scalar_range m",
                           "scalar_azimuth rad, positive to port", "scalar_true_surfel id in the scene; -1: none"})
    EXPECT_THAT(comments, HasSubstr(std::string("comment unit ") + unit + "\n"));
  ASSERT_EQ(bytes.size(), end + 20 * 64);
  const char* at = bytes.data() + end;
  for (std::size_t i = 0; i < 20; ++i, at += 64) {
    double position[3];
    float reals[4], elevation;
    std::uint32_t whole[3], known[2];
    std::memcpy(position, at, 24);
    std::memcpy(reals, at + 24, 16);
    std::memcpy(whole, at + 40, 12);
    std::memcpy(&elevation, at + 52, 4);
    std::memcpy(known, at + 56, 8);
    EXPECT_EQ(Eigen::Vector3d(position[0], position[1], position[2]), s.position[i]);
    EXPECT_EQ((std::vector<float>(reals, reals + 4)),
              (std::vector<float>{s.level_db[i], s.range[i], s.azimuth[i], s.elevation[i]}));
    EXPECT_EQ((std::vector<std::uint32_t>(whole, whole + 3)), (std::vector<std::uint32_t>{7, s.beam[i], s.bin[i]}));
    EXPECT_EQ(elevation, s.true_elevation[i]);
    EXPECT_EQ((std::pair(known[0], known[1])), (std::pair(s.true_surfel[i], s.true_material[i])));
  }
}

TEST(SaveSoundings, orders_come_back_where_they_are_known) {
  Soundings s = some_soundings();
  const std::string path = own_path("a.ply"), without = own_path("b.ply");
  save_soundings(without, s);
  s.true_order.assign(s.size(), 1), s.true_order[3] = 2;
  save_soundings(path, s);
  EXPECT_EQ(load_soundings(path).true_order, s.true_order);
  EXPECT_TRUE(load_soundings(without).true_order.empty());
}

TEST(SaveSoundings, files_of_unsigned_columns_are_read_as_those_of_today) {
  Soundings s = some_soundings();
  s.true_surfel[3] = s.true_material[3] = Soundings::none;
  s.true_surfel[4] = 3000000000;
  const std::string today = own_path("today.ply");
  save_soundings(today, s);
  std::string old = file_bytes(today);
  for (std::size_t at = 0; (at = old.find("property int ", at)) != old.npos;) old.replace(at, 12, "property uint");
  for (const std::string& path : {today, own_file("old.ply", old)}) {
    const Soundings loaded = load_soundings(path);
    EXPECT_EQ(loaded.true_surfel, s.true_surfel);
    EXPECT_EQ(loaded.true_material, s.true_material);
    EXPECT_EQ(loaded.ping, s.ping);
  }
  // Both join, and returns without a surfel lie on no bed.
  join_clouds(own_path("both.ply"), {own_path("old.ply"), today});
  EXPECT_THAT(file_bytes(own_path("both.ply")), HasSubstr("property int scalar_true_surfel\n"));
  EXPECT_EQ(load_soundings(own_path("both.ply")).true_surfel.at(23), Soundings::none);
}

TEST(SaveSoundings, a_pcd_opens_in_pcl_with_all_fields) {
  const Soundings s = some_soundings();
  const std::string path = own_path("a.pcd");
  const Eigen::Vector3d origin = save_soundings(path, s);
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector4f viewpoint;
  Eigen::Quaternionf turn;
  int version = 0;
  ASSERT_EQ(pcl::PCDReader().read(path, cloud, viewpoint, turn, version), 0);
  ASSERT_EQ(cloud.width * cloud.height, 20u);
  std::string names;
  for (const auto& field : cloud.fields) names += field.name + " ";
  EXPECT_EQ(names,
            "x y z level_db range azimuth elevation ping beam bin true_elevation true_surfel true_material intensity "
            "label ");
  for (std::size_t i = 0; i < 20; ++i) {
    float reals[7];
    std::uint32_t whole[4];
    std::memcpy(reals, cloud.data.data() + i * cloud.point_step, 28);
    std::memcpy(whole, cloud.data.data() + i * cloud.point_step + 28, 16);
    EXPECT_EQ(reals[2], static_cast<float>(s.position[i].z()));
    EXPECT_EQ(reals[3], s.level_db[i]);
    EXPECT_EQ(whole[2], s.bin[i]);
  }
  // PCL's own point types find their names.
  pcl::PointCloud<pcl::PointXYZI> levels;
  pcl::PointCloud<pcl::PointXYZL> labels;
  pcl::fromPCLPointCloud2(cloud, levels);
  pcl::fromPCLPointCloud2(cloud, labels);
  EXPECT_EQ(levels.at(7).intensity, s.level_db[7]);
  EXPECT_EQ(labels.at(7).label, s.true_material[7]);
  // Far from zero float32 would lose 0.25 m of northing: the points count from an origin that the VIEWPOINT gives.
  EXPECT_EQ(origin, Eigen::Vector3d(500000, 4600000, 0));
  EXPECT_EQ(viewpoint, Eigen::Vector4f(500000, 4600000, 0, 0));
  EXPECT_THAT(file_bytes(path), HasSubstr("VIEWPOINT 500000 4600000 0 1 0 0 0\n"));
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_LT((origin + levels.at(i).getVector3fMap().cast<double>() - s.position[i]).norm(), 2e-6);
}

TEST(SaveSoundings, a_pcd_near_zero_holds_world_coordinates) {
  Soundings s = some_soundings();
  for (Eigen::Vector3d& p : s.position) p -= Eigen::Vector3d(500000, 4600000, 0);
  const std::string path = own_path("a.pcd");
  EXPECT_EQ(save_soundings(path, s), Eigen::Vector3d::Zero());
  EXPECT_THAT(file_bytes(path), HasSubstr("VIEWPOINT 0 0 0 1 0 0 0\n"));
  pcl::PointCloud<pcl::PointXYZ> cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(path, cloud), 0);
  EXPECT_EQ(cloud.at(3).getVector3fMap(), s.position[3].cast<float>());
}

TEST(SaveSoundings, no_soundings_make_a_file_with_no_points) {
  for (const char* name : {"a.ply", "a.pcd"}) {
    const std::string path = own_path(name);
    save_soundings(path, {});
    EXPECT_THAT(file_bytes(path), ::testing::ContainsRegex("(element vertex|POINTS) 0"));
  }
}

TEST(SaveSoundings, columns_of_different_lengths_are_refused) {
  Soundings s = some_soundings();
  s.beam.pop_back();
  expect_error(ErrorKind::argument, {"save_soundings", "20 positions", "length 19"},
               [&] { save_soundings(own_path("a.ply"), s); });
}

}  // namespace insonify::save_soundings_tests
