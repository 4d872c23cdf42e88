// SPDX-License-Identifier: BSD-3-Clause
// Objects of a data set: the instances of the scene, and those of its images.
#include <hdf5.h>

#include "tool/dataset_fixture.hpp"

namespace {

/// A label image as HDF5 reads it.
std::vector<std::uint32_t> raw_labels(const std::string& path, const char* name) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), set = H5Dopen2(file, name, H5P_DEFAULT),
              space = H5Dget_space(set);
  std::vector<std::uint32_t> labels(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(set, H5T_NATIVE_UINT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, labels.data());
  H5Sclose(space), H5Dclose(set), H5Fclose(file);
  return labels;
}

}  // namespace

TEST_F(DatasetRun, objects_are_the_instances_of_the_scene) {
  // Two spheres of one material beside each other on a plane: by the field, each is an object.
  std::string rows = "x,y,z,nx,ny,nz,area,material,instance\n";
  for (int i = -60; i <= 60; ++i)
    for (int j = -60; j <= 60; ++j)
      rows += std::to_string(6 + 0.05 * i) + "," + std::to_string(0.05 * j) + ",-1,0,0,1,0.0025,0,-1\n";
  for (int s = 0; s < 2; ++s)
    for (int k = 0; k < 4000; ++k) {
      const double z = 1 - (k + 0.5) / 2000, turn = 2.399963 * k, r = std::sqrt(1 - z * z);
      const Eigen::Vector3d n(r * std::cos(turn), r * std::sin(turn), z),
          p = Eigen::Vector3d(6, s ? 0.35 : -0.35, -0.7) + 0.34 * n;
      std::ostringstream line;
      line << p.x() << "," << p.y() << "," << p.z() << "," << n.x() << "," << n.y() << "," << n.z() << ","
           << 4 * pi * 0.34 * 0.34 / 4000 << ",1," << s << "\n";
      rows += line.str();
    }
  write("balls.csv", rows);
  succeed(
      "ping balls.csv --sonar p900-45 --set sonar.beams=64 --pose=0,0,0,0,8,0 --range 3:9 --no-picture -q --keep "
      "contributors -o balls");
  succeed("dataset balls -o set --least-pixels 30");
  std::map<int, std::set<int>> of_category;
  const nlohmann::json all = coco("polar");
  for (const auto& a : all["annotations"]) of_category[a["category_id"]].insert(a["instance"].get<int>());
  const nlohmann::json classes = manifest_of("set")["classes"];
  ASSERT_EQ(classes.size(), 4U);
  EXPECT_EQ(of_category[3].size(), 2U);  // the balls touch in the image, and are two nevertheless
  // Prepared, the scene has the same objects.
  succeed("prepare balls.csv -o balls.ply -q");
  succeed(
      "ping balls.ply --sonar p900-45 --set sonar.beams=64 --pose=0,0,0,0,8,0 --range 3:9 --no-picture -q --keep "
      "contributors -o prepared");
  succeed("dataset prepared -o prepared_set --least-pixels 30");
  const nlohmann::json again = read_json("prepared_set/polar/annotations/instances_train.json");
  EXPECT_EQ(again["annotations"], all["annotations"]);
  // So they are in the images of the run itself, where surfels of a ball are of its instance.
  const std::vector<std::uint32_t> material = raw_labels(path("balls/contributors.h5"), "/material_image"),
                                   object = raw_labels(path("balls/contributors.h5"), "/instance_image");
  std::map<std::uint32_t, int> pixels_of;
  for (std::size_t i = 0; i < object.size(); ++i)
    if (material[i] == 1) ++pixels_of[object[i]];
  EXPECT_EQ(pixels_of.size(), 2U);
  for (const auto& [number, pixels] : pixels_of) {
    EXPECT_GT(number, 0U);
    EXPECT_GT(pixels, 30);
  }
}
