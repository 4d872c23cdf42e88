// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The content of a file by a reader that shares no code with insonify (bounds_of_file.py).
#include "scene_io/describe_file.hpp"
#include "scene_io/test_files.hpp"

namespace insonify {

struct FoundInFile {
  Bounds box;
  double area = 0;  ///< sum over the polygons [m^2]
};

/// Returns nothing without Python, or without h5py for a file of HDF5.
inline std::optional<FoundInFile> found_in_file(const std::string& path) {
  const std::string said = own_path("bounds.txt");
  const std::string command = "/usr/bin/python3 " INSONIFY_BOUNDS_OF_FILE " " + path + " >" + said + " 2>&1";
  const int status = std::system(command.c_str()), code = status / 256;
  if (code == 77 || code == 127) return std::nullopt;
  FoundInFile found;
  std::istringstream words(file_bytes(said));
  for (Eigen::Vector3d* corner : {&found.box.min, &found.box.max})
    for (double& coordinate : *corner) words >> coordinate;
  EXPECT_TRUE(words >> found.area) << path << ": " << file_bytes(said);
  return found;
}

/// Expects box and triangles' area of a file, as described and as loaded, to agree with the other reader. Returns false
/// if that cannot read the file here.
inline bool has_bounds_of_other_reader(const std::string& path) {
  const std::optional<FoundInFile> found = found_in_file(path);
  if (!found) return false;
  const LoadedScene loaded = load_scene(path);
  Bounds box = bounds(loaded.scene);
  if (found->area > 0) {
    EXPECT_TRUE(loaded.mesh) << path;
    box = {};
    for (const Eigen::Vector3f& p : loaded.mesh->point) {
      const Eigen::Vector3d position = loaded.mesh->origin + p.cast<double>();
      box = {box.min.cwiseMin(position), box.max.cwiseMax(position)};
    }
    EXPECT_NEAR(area_of_mesh(loaded), found->area, 1e-6 * found->area) << path;
  }
  // Points are single precision about the origin of the scene.
  const double size = (found->box.max - found->box.min).norm();
  EXPECT_LT((box.min - found->box.min).norm(), 1e-7 * size) << path;
  EXPECT_LT((box.max - found->box.max).norm(), 1e-7 * size) << path;
  if (path.ends_with(".tiles")) return true;
  const FileDescription described = describe_file(path);
  EXPECT_LT((described.min - found->box.min).norm(), 1e-12 * found->box.min.norm()) << path;
  EXPECT_LT((described.max - found->box.max).norm(), 1e-12 * found->box.max.norm()) << path;
  return true;
}

}  // namespace insonify
