// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/PCLPointCloud2.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>

#include "scene_io/save_cloud.hpp"
#include "scene_io/test_files.hpp"
#include "support/test.hpp"

namespace {

/// Returns three surfels; the middle one was never insonified.
SceneCloud three_surfels(const Eigen::Vector3d& origin) {
  SceneCloud scene;
  scene.origin = origin;
  scene.materials = {{"sand", 0.01}, {"rock", 0.1}};
  for (int i = 0; i < 3; ++i)
    add_surfel(scene, origin + Eigen::Vector3d(1 + i, 2, -0.5), {0, 0, 1}, 0.01, static_cast<std::uint16_t>(i % 2));
  return scene;
}

std::vector<CoveredSurfel> two_entries() {
  return {{0, 3, {}, static_cast<float>(radians(30)), 7.25F, 1, 120.5F, -27, 140}, {2, 1, {}, 1, 9, 1, 99, -30, 120}};
}

template <typename T>
T field(const pcl::PCLPointCloud2& cloud, std::size_t point, const std::string& name) {
  for (const auto& f : cloud.fields)
    if (f.name == name) {
      T value;
      std::memcpy(&value, cloud.data.data() + point * cloud.point_step + f.offset, sizeof value);
      return value;
    }
  ADD_FAILURE() << "no field " << name;
  return T{};
}

}  // namespace

TEST(SaveInsonification, a_pcd_opens_in_pcl_with_normals_and_fields) {
  const std::string path = own_path("map.pcd");
  save_insonification(path, three_surfels({10, 0, 0}), two_entries());
  pcl::PCLPointCloud2 cloud;
  ASSERT_EQ(pcl::PCDReader().read(path, cloud), 0);
  ASSERT_EQ(cloud.width * cloud.height, 3U);
  EXPECT_EQ(field<float>(cloud, 0, "x"), 11);
  EXPECT_EQ(field<float>(cloud, 2, "normal_z"), 1);
  EXPECT_EQ(field<float>(cloud, 0, "level_db"), 120.5F);
  EXPECT_EQ(field<float>(cloud, 0, "scattering_db"), -27);
  EXPECT_EQ(field<float>(cloud, 2, "cell_level_db"), 120);
  EXPECT_NEAR(field<float>(cloud, 0, "grazing_deg"), 30, 1e-5);
  EXPECT_EQ(field<float>(cloud, 0, "range"), 7.25F);
  EXPECT_EQ(field<std::uint32_t>(cloud, 0, "hits"), 3U);
  EXPECT_EQ(field<std::uint32_t>(cloud, 1, "material"), 1U);
  EXPECT_EQ(field<std::uint32_t>(cloud, 2, "id"), 2U);
}

TEST(SaveInsonification, surfels_never_insonified_have_no_level) {
  const std::string path = own_path("map.pcd");
  save_insonification(path, three_surfels({0, 0, 0}), two_entries());
  pcl::PCLPointCloud2 cloud;
  ASSERT_EQ(pcl::PCDReader().read(path, cloud), 0);
  EXPECT_EQ(field<std::uint32_t>(cloud, 1, "hits"), 0U);
  for (const char* name : {"level_db", "scattering_db", "cell_level_db", "grazing_deg", "range"})
    EXPECT_TRUE(std::isnan(field<float>(cloud, 1, name)));
}

TEST(SaveInsonification, a_ply_names_scalar_fields_and_keeps_far_coordinates) {
  const std::string path = own_path("map.ply");
  save_insonification(path, three_surfels({500000, 4600000, -20}), two_entries());
  const std::string bytes = file_bytes(path);
  EXPECT_THAT(bytes, HasSubstr("element vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
                               "property float nx\nproperty float ny\nproperty float nz\n"
                               "property float scalar_level_db\nproperty float scalar_scattering_db\n"
                               "property float scalar_cell_level_db\nproperty float scalar_grazing_deg\n"
                               "property float scalar_range\nproperty int scalar_hits\n"
                               "property int scalar_material\nproperty int scalar_id\nend_header\n"));
  const std::size_t start = bytes.find("end_header\n") + 11, row = 3 * 8 + 11 * 4;
  ASSERT_EQ(bytes.size(), start + 3 * row);
  double x = 0;
  std::memcpy(&x, bytes.data() + start, sizeof x);
  EXPECT_NEAR(x, 500001, 1e-6);
  std::uint32_t hits = 0;
  std::memcpy(&hits, bytes.data() + start + 2 * row + 3 * 8 + 8 * 4, sizeof hits);
  EXPECT_EQ(hits, 1U);
}

TEST(SaveInsonification, of_another_scene_is_refused) {
  std::vector<CoveredSurfel> map = two_entries();
  map.back().id = 3;
  expect_error(ErrorKind::argument, {"save_insonification: ", "surfel 3 is not in the scene"}, [&] {
    save_insonification(own_path("map.ply"), three_surfels({0, 0, 0}), map);
  });
  expect_error(ErrorKind::argument, {"extension '.xyz'"}, [&] {
    save_insonification(own_path("map.xyz"), three_surfels({0, 0, 0}), two_entries());
  });
}
