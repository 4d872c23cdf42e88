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
           << 4 * pi * 0.34 * 0.34 / 4000 << ",1," << s + 1 << "\n";
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

namespace {

/// Rows of a ball: of one material, or below 0 of material 1 on a cap that looks to the head and of 2 elsewhere.
std::string ball_rows(double x, double y, int material, std::int64_t instance, double radius = 0.3, double z = -0.7) {
  std::ostringstream rows;
  const int points = 3000;
  for (int k = 0; k < points; ++k) {
    const double up = 1 - (k + 0.5) / (points / 2), turn = 2.399963 * k, r = std::sqrt(1 - up * up);
    const Eigen::Vector3d n(r * std::cos(turn), r * std::sin(turn), up), p = Eigen::Vector3d(x, y, z) + radius * n;
    rows << p.x() << "," << p.y() << "," << p.z() << "," << n.x() << "," << n.y() << "," << n.z() << ","
         << 4 * pi * radius * radius / points << "," << (material < 0 ? (n.x() > -0.7 ? 2 : 1) : material) << ","
         << instance << "\n";
  }
  return rows.str();
}

std::string bed_rows() {
  std::string rows = "x,y,z,nx,ny,nz,area,material,instance\n";
  for (int i = -60; i <= 60; ++i)
    for (int j = -60; j <= 60; ++j)
      rows += std::to_string(6 + 0.05 * i) + "," + std::to_string(0.05 * j) + ",-1,0,0,1,0.0025,0,0\n";
  return rows;
}

}  // namespace

// At any pose an object has the number that the scene gives it; one id on two materials is one object.
TEST_F(DatasetRun, numbers_of_objects_are_those_of_the_scene_in_every_image) {
  write("ids.csv", bed_rows() + ball_rows(6, -0.8, 1, 7) + ball_rows(6, 0.8, -1, 42) + ball_rows(7.5, 0.1, 1, 100000));
  std::string runs;
  for (const int yaw : {-12, 0, 12}) {
    const std::string run = "ids" + std::to_string(yaw);
    succeed("ping ids.csv --sonar p900-45 --set sonar.beams=64 --pose=0,0,0," + std::to_string(yaw) +
            ",8,0 --range 3:9 --no-picture -q --keep contributors -o " + run);
    runs += run + " ";
  }
  succeed("dataset " + runs + "-o set --least-pixels 10 --split 100:0:0 --min-contrast=-1000");
  for (const std::string form : {"polar", "fan"}) {
    const nlohmann::json all = coco(form);
    std::map<int, std::vector<int>> objects_of_image;
    for (const auto& a : all["annotations"]) {
      const int number = a["instance"];
      EXPECT_EQ(a["found_by"], number > 42 ? "connection" : "instance");
      if (number <= 42) objects_of_image[a["image_id"]].push_back(number);
    }
    EXPECT_EQ(objects_of_image.size(), 3U) << form;
    for (auto& [image, numbers] : objects_of_image) {
      std::sort(numbers.begin(), numbers.end());
      EXPECT_EQ(numbers, (std::vector<int>{1, 7, 42})) << form << image;  // each once; 1 stands for 100000
    }
  }
  EXPECT_EQ(manifest_of("set")["renumbered_instances"].begin()->dump(), "{\"1\":100000}");
}

// A ball of the bed's own strength is in the masks, and has a box only if it stands out.
TEST_F(DatasetRun, boxes_are_of_objects_that_stand_out) {
  write("weak.csv", bed_rows() + ball_rows(6, 0, 1, 3));
  succeed(
      "ping weak.csv --sonar p900-45 --set sonar.beams=64 --pose=0,0,0,0,8,0 --range 3:9 --no-picture -q --keep "
      "contributors --noise -o heard");
  succeed(
      "ping weak.csv --sonar p900-45 --set sonar.beams=64 --set sonar.source_level_db=60 --pose=0,0,0,0,8,0 "
      "--range 3:9 --no-picture -q --keep contributors --noise -o drowned");
  const auto boxes = [&](const std::string& run, const std::string& options) {
    succeed("dataset " + run + " -o set --force --share 0.01 --split 100:0:0 " + options);
    std::size_t of_ball = 0;
    const nlohmann::json all = coco("fan");
    for (const auto& a : all["annotations"]) of_ball += a["instance"] == 3;
    return of_ball;
  };
  EXPECT_EQ(boxes("heard", ""), 1U);
  EXPECT_GT(coco("fan")["annotations"][0]["contrast_db"].get<double>(), 3);
  EXPECT_EQ(boxes("drowned", ""), 0U);
  EXPECT_EQ(boxes("heard", "--min-contrast 80"), 0U);
  const nlohmann::json meta = nlohmann::json::parse(read("set/meta.jsonl"));
  EXPECT_EQ(meta["unboxed"]["fan"][0]["instance"], 3);
  EXPECT_LT(meta["unboxed"]["fan"][0]["contrast_db"].get<double>(), 80);
  EXPECT_GT((png("fan/instances/000_000000.png").value == 3).count(), 0);
}
