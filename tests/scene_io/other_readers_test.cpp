// SPDX-License-Identifier: BSD-3-Clause
// Compares bounds of clouds and meshes, and areas of meshes, with a reader of each format in Python.
#include "scene_io/bounds_of_file.hpp"
#include "scene_io/gltf_maker.hpp"
#include "scene_io/las_file.hpp"
#include "scene_io/save_cloud.hpp"
#include "tiles/tile_writer.hpp"

namespace {

using Eigen::Vector3d;

/// Returns flat polygons with corners and slopes of their own; every third one of five corners or more is concave.
std::vector<std::vector<Vector3d>> polygons_of(std::size_t most_corners, const Vector3d& origin = {300, 200, -20}) {
  std::vector<std::vector<Vector3d>> polygons;
  for (std::size_t p = 0; p < 40; ++p) {
    const std::size_t corners = 3 + p % (most_corners - 2);
    const double x = 3.7 * static_cast<double>(p % 8), y = 3.1 * static_cast<double>(p / 8);
    auto& polygon = polygons.emplace_back();
    for (std::size_t c = 0; c < corners; ++c) {
      const double radius = corners > 4 && p % 3 == 0 && c == 1 ? 0.1 : 1.0 + 0.01 * static_cast<double>(p + c);
      const double angle = 2 * pi * static_cast<double>(c) / static_cast<double>(corners) + 0.3;
      const double u = radius * std::cos(angle), v = radius * std::sin(angle);
      polygon.push_back(origin + Vector3d(x + u, y + v, 0.02 * x * y + 0.1 * static_cast<double>(p % 5) * u - 0.2 * v));
    }
  }
  return polygons;
}

struct Text {
  std::ostringstream points{}, faces{};
  std::size_t count = 0, numbers = 0;  ///< numbers of points, and of the indices of faces
};

/// Returns points and faces as lines with a word before each; corners count from `first`.
Text lines_of(const std::vector<std::vector<Vector3d>>& polygons, const char* before_point, const char* before_face,
              std::size_t first) {
  Text text;
  text.points.precision(17);
  for (const auto& polygon : polygons) {
    text.faces << (*before_face ? before_face : std::to_string(polygon.size()));
    for (const Vector3d& p : polygon) {
      text.points << before_point << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
      text.faces << ' ' << first + text.count++;
    }
    text.faces << '\n';
    text.numbers += polygon.size() + 1;
  }
  return text;
}

/// Returns a few hundred points of a bed, single precision.
std::vector<Eigen::Vector3f> cloud_points() {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 400; ++i)
    points.emplace_back(static_cast<float>(0.37 * (i % 20) + 0.01 * (i % 7)), static_cast<float>(0.41 * (i / 20)),
                        static_cast<float>(-7 + 0.1 * (i % 11)));
  return points;
}

void expect_bounds(const std::string& path) {
  if (!has_bounds_of_other_reader(path)) GTEST_SKIP() << "/usr/bin/python3 or its h5py is not there";
}

TEST(OtherReaders, find_the_bounds_and_the_area_of_an_obj) {
  const Text text = lines_of(polygons_of(7), "v ", "f", 1);
  expect_bounds(own_file("a.obj", text.points.str() + text.faces.str()));
}

TEST(OtherReaders, find_the_bounds_and_the_area_of_a_ply) {
  const Text text = lines_of(polygons_of(7), "", "", 0);
  expect_bounds(own_file("a.ply", "ply\nformat ascii 1.0\nelement vertex " + std::to_string(text.count) +
                                      "\nproperty double x\nproperty double y\nproperty double z\nelement face 40\n" +
                                      "property list uchar int vertex_indices\nend_header\n" + text.points.str() +
                                      text.faces.str()));
  std::string head = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(text.count) +
                     "\nproperty float x\nproperty uchar flag\nproperty float y\nproperty float z\nelement face 40\n"
                     "property list ushort uint vertex_indices\nend_header\n",
              points, faces;
  std::uint32_t corner = 0;
  // Triangles: in single precision, other polygons are not quite flat.
  for (const auto& polygon : polygons_of(3)) {
    faces += bytes_of(static_cast<std::uint16_t>(polygon.size()));
    for (const Vector3d& p : polygon) {
      points += bytes_of(static_cast<float>(p.x())) + "\x01" + bytes_of(static_cast<float>(p.y())) +
                bytes_of(static_cast<float>(p.z()));
      faces += bytes_of(corner++);
    }
  }
  expect_bounds(own_file("b.ply", replaced(head, std::to_string(text.count), std::to_string(corner)) + points + faces));
}

TEST(OtherReaders, find_the_bounds_and_the_area_of_a_vtk) {
  const Text text = lines_of(polygons_of(7), "", "", 0);
  expect_bounds(own_file("a.vtk", "# vtk DataFile Version 3.0\nbed\nASCII\nDATASET POLYDATA\nPOINTS " +
                                      std::to_string(text.count) + " double\n" + text.points.str() + "POLYGONS 40 " +
                                      std::to_string(text.numbers) + "\n" + text.faces.str()));
}

TEST(OtherReaders, find_the_bounds_and_the_area_of_an_stl) {
  std::ostringstream text;
  text.precision(17);
  text << "solid bed\n";
  std::string binary(80, '\0');
  binary += bytes_of(std::uint32_t{40});
  for (const auto& triangle : polygons_of(3)) {
    text << "facet normal 0 0 1\nouter loop\n";
    binary += std::string(12, '\0');
    for (const Vector3d& p : triangle) {
      text << "vertex " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
      for (const double coordinate : p) binary += bytes_of(static_cast<float>(coordinate));
    }
    text << "endloop\nendfacet\n";
    binary += std::string(2, '\0');
  }
  expect_bounds(own_file("a.stl", text.str() + "endsolid bed\n"));
  expect_bounds(own_file("b.stl", binary));
}

TEST(OtherReaders, find_the_bounds_and_the_area_of_a_gltf) {
  GltfMaker maker;
  std::vector<float> numbers;
  std::vector<std::uint16_t> corners;
  for (const auto& triangle : polygons_of(3, {3, -20, 2}))
    for (const Vector3d& p : triangle) {
      corners.push_back(static_cast<std::uint16_t>(corners.size()));
      for (const double coordinate : p) numbers.push_back(static_cast<float>(coordinate));
    }
  maker.primitive()["attributes"]["POSITION"] = maker.add(numbers);
  maker.primitive()["indices"] = maker.add(corners, "SCALAR");
  expect_bounds(own_file("a.gltf", maker.text()));
}

TEST(OtherReaders, find_the_bounds_of_a_pcd_and_of_text) {
  std::ostringstream text;
  text.precision(9);
  std::string rows;
  for (const Eigen::Vector3f& p : cloud_points()) {
    text << p.x() << ' ' << p.y() << ' ' << p.z() << " 7\n";
    rows += bytes_of(p.x()) + bytes_of(p.y()) + bytes_of(p.z()) + '\x07';
  }
  const std::string head =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z label\nSIZE 4 4 4 1\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 400\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 400\nDATA ";
  expect_bounds(own_file("a.pcd", head + "ascii\n" + text.str()));
  expect_bounds(own_file("b.pcd", head + "binary\n" + rows));
  expect_bounds(own_file("a.xyz", text.str()));
}

TEST(OtherReaders, find_the_bounds_of_a_las) {
  LasFile file;
  std::vector<Vector3d> positions;
  for (const Eigen::Vector3f& p : cloud_points()) positions.push_back(file.offset + p.cast<double>());
  for (const int format : {0, 3, 5}) {
    file.format = format;
    expect_bounds(own_file("a.las", file.bytes(positions)));
  }
}

TEST(OtherReaders, find_the_bounds_of_tiles) {
  const SceneCloud scene = harbour(5000);
  save_tiles(own_path("a.tiles"), scene, {.tile_surfels = 300});
  expect_bounds(own_path("a.tiles"));
}

}  // namespace
