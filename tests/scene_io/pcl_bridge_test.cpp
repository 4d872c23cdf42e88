// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/pcl_bridge.hpp"

#include <pcl/conversions.h>

#include "scene_io/test_files.hpp"
#include "support/test.hpp"

namespace {

pcl::PointCloud<pcl::PointXYZ> plate() {
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (int i = 0; i < 100; ++i)
    cloud.push_back({static_cast<float>(i / 10) * 0.5f, static_cast<float>(i % 10) * 0.5f, 2});
  return cloud;
}

TEST(PclBridge, a_cloud_in_memory_behaves_as_the_same_cloud_in_a_file) {
  pcl::PointCloud<pcl::PointXYZ> cloud = plate();
  cloud.push_back({std::numeric_limits<float>::quiet_NaN(), 0, 0});
  cloud.push_back(cloud[5]);
  const LoadedScene loaded = from_pcl(cloud);
  EXPECT_EQ(loaded.scene.size(), 100u);
  EXPECT_EQ(loaded.report.dropped_not_finite, 1u);
  EXPECT_EQ(loaded.report.dropped_duplicates, 1u);
  EXPECT_TRUE(loaded.scene.normals_oriented);  // a raster of heights looks up
  const LoadedScene from_file = load_scene(own_file("a.xyz", plate_text(10, 0.5, 0, 0, 2)));
  EXPECT_EQ(loaded.scene.point, from_file.scene.point);
  EXPECT_EQ(loaded.scene.normal, from_file.scene.normal);
  EXPECT_EQ(loaded.scene.area, from_file.scene.area);
}

TEST(PclBridge, the_pose_of_the_sensor_orients_the_normals) {
  pcl::PointCloud<pcl::PointXYZ> cloud = plate();
  cloud.sensor_origin_ = Eigen::Vector4f(2, 2, 5, 0);
  for (const auto& n : from_pcl(cloud).scene.normal) EXPECT_GT(n.z(), 0.999f);
  cloud.sensor_origin_.setZero();
  cloud.sensor_orientation_ = Eigen::Quaternionf(0, 1, 0, 0);
  for (const auto& n : from_pcl(cloud).scene.normal) EXPECT_LT(n.z(), -0.999f);
}

TEST(PclBridge, point_normals_come_through_and_go_back) {
  pcl::PointCloud<pcl::PointNormal> cloud;
  for (const auto& p : plate()) {
    pcl::PointNormal n;
    n.getVector3fMap() = p.getVector3fMap();
    n.getNormalVector3fMap() = Eigen::Vector3f(0, 0.6f, 0.8f);
    cloud.push_back(n);
  }
  const LoadedScene loaded = from_pcl(cloud);
  EXPECT_FALSE(loaded.report.normals_estimated);
  const pcl::PointCloud<pcl::PointNormal> back = to_pcl(loaded.scene);
  ASSERT_EQ(back.size(), cloud.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    EXPECT_EQ(back[i].getVector3fMap(), cloud[i].getVector3fMap());
    EXPECT_LT((back[i].getNormalVector3fMap() - cloud[i].getNormalVector3fMap()).norm(), 1e-6f);
  }
}

TEST(PclBridge, a_polygon_mesh_is_sampled) {
  pcl::PointCloud<pcl::PointXYZ> corners;
  for (const auto& p : {pcl::PointXYZ(0, 0, 0), pcl::PointXYZ(2, 0, 0), pcl::PointXYZ(2, 3, 0), pcl::PointXYZ(0, 3, 0)})
    corners.push_back(p);
  pcl::PolygonMesh mesh;
  pcl::toPCLPointCloud2(corners, mesh.cloud);
  mesh.polygons.resize(2);
  mesh.polygons[0].vertices = {0, 1, 2, 3};
  mesh.polygons[1].vertices = {0, 1, 77};
  LoadOptions options;
  options.mesh_spacing = 0.1;
  const LoadedScene loaded = from_pcl(mesh, options);
  EXPECT_EQ(loaded.scene.size(), 600u);
  EXPECT_EQ(loaded.report.dropped_degenerate, 1u);
  EXPECT_NEAR(total_area(loaded.scene), 6, 1e-5);
  for (const auto& n : loaded.scene.normal) EXPECT_EQ(n, Eigen::Vector3f(0, 0, 1));
}

TEST(PclBridge, blobs_whose_sizes_contradict_each_other_are_refused) {
  pcl::PCLPointCloud2 blob;
  pcl::toPCLPointCloud2(plate(), blob);
  pcl::PCLPointCloud2 cut = blob;
  cut.data.resize(cut.data.size() - 1);
  expect_error(ErrorKind::content, {"from_pcl", "the cloud holds 1599"}, [&] { from_pcl(cut); });
  pcl::PCLPointCloud2 outside = blob;
  outside.fields[2].offset = 14;
  expect_error(ErrorKind::content, {"from_pcl", "field 'z' ends beyond"}, [&] { from_pcl(outside); });
  pcl::PCLPointCloud2 nameless = blob;
  nameless.fields.pop_back();
  expect_error(ErrorKind::content, {"from_pcl", "expected fields x y z"}, [&] { from_pcl(nameless); });
  expect_error(ErrorKind::content, {"from_pcl", "holds no point"}, [] { from_pcl(pcl::PCLPointCloud2{}); });
}

TEST(PclBridge, soundings_become_a_cloud_with_named_fields) {
  Soundings s;
  s.position = {{1, 2, 3}};
  s.level_db = {120};
  s.range = {4};
  s.azimuth = {0.5f};
  s.elevation = {-0.25f};
  s.ping = {1};
  s.beam = {2};
  s.bin = {3};
  s.true_elevation = {-0.2f};
  s.true_surfel = {5};
  s.true_material = {4};
  const pcl::PCLPointCloud2 cloud = to_pcl(s);
  ASSERT_EQ(cloud.fields.size(), 13u);
  EXPECT_EQ(cloud.fields[3].name, "level_db");
  EXPECT_EQ(cloud.fields[12].datatype, pcl::PCLPointField::UINT32);
  EXPECT_EQ(cloud.data.size(), 52u);
  pcl::PointCloud<pcl::PointXYZ> xyz;
  pcl::fromPCLPointCloud2(cloud, xyz);
  EXPECT_EQ(xyz[0].z, 3);
}

}  // namespace
