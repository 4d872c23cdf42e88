// SPDX-License-Identifier: BSD-3-Clause
#include <vtkCubeSource.h>
#include <vtkNew.h>
#include <vtkPolyDataWriter.h>
#include <vtkSTLWriter.h>
#include <vtkSphereSource.h>
#include <vtkStripper.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataWriter.h>

#include "scene_io/test_files.hpp"
#include "support/test.hpp"

namespace {

/// Returns a box of 0.5 x 1 x 1 m, 8 vertices and 12 triangles, wound outwards; `flip` reverses triangle 0, `inside`
/// all.
std::string cube_obj(bool flip = false, bool inside = false) {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    text += "v ";
    text += i & 1 ? "0.5 " : "0 ";
    text += i & 2 ? "1 " : "0 ";
    text += i & 4 ? "1\n" : "0\n";
  }
  const int faces[12][3] = {{1, 3, 2}, {2, 3, 4}, {5, 6, 7}, {6, 8, 7}, {1, 2, 5}, {2, 6, 5},
                            {3, 7, 4}, {4, 7, 8}, {1, 5, 3}, {3, 5, 7}, {2, 4, 6}, {4, 8, 6}};
  for (int f = 0; f < 12; ++f) {
    const bool turned = inside != (flip && f == 0);
    text += "f " + std::to_string(faces[f][0]) + " " + std::to_string(faces[f][turned ? 2 : 1]) + " " +
            std::to_string(faces[f][turned ? 1 : 2]) + "\n";
  }
  return text;
}

// The box is 0.5 x 1 x 1: area 2 (0.5 + 0.5 + 1) = 4.
constexpr double box_area = 4;

TEST(Mesh, surfels_keep_the_total_area_and_lie_on_the_faces_with_outward_normals) {
  LoadOptions options;
  options.mesh_spacing = 0.02;
  const LoadedScene loaded = load_scene(own_file("a.obj", cube_obj()), options);
  EXPECT_EQ(loaded.scene.size(), 10000u);  // 4 m^2 / 0.02^2
  EXPECT_NEAR(total_area(loaded.scene), box_area, 1e-6 * box_area);
  EXPECT_TRUE(loaded.scene.normals_oriented);
  EXPECT_EQ(loaded.report.triangles_read, 12u);
  const Eigen::Vector3d half(0.25, 0.5, 0.5);
  for (std::size_t i = 0; i < loaded.scene.size(); ++i) {
    const Eigen::Vector3d from_centre = world(loaded.scene, i) - half;
    const Eigen::Vector3d n = loaded.scene.normal[i].cast<double>();
    EXPECT_NEAR(n.dot(from_centre), n.cwiseAbs().dot(half), 1e-6);  // on the face its normal points out of
  }
}

TEST(Mesh, every_triangle_gets_its_share_of_surfels_within_one) {
  // Triangles of very different area along a strip of height 1: widths 1, 1/2, 1/4, ... 1/512.
  std::string text = "v 0 0 0\nv 0 1 0\n";
  double x = 0, width = 1;
  std::vector<double> edge = {0};
  for (int i = 0; i < 10; ++i, width /= 2) {
    edge.push_back(x += width);
    text += "v " + std::to_string(x) + " 0 0\nv " + std::to_string(x) + " 1 0\n";
    const int a = 2 * i + 1;
    text += "f " + std::to_string(a) + " " + std::to_string(a + 2) + " " + std::to_string(a + 1) + "\nf " +
            std::to_string(a + 2) + " " + std::to_string(a + 3) + " " + std::to_string(a + 1) + "\n";
  }
  LoadOptions options;
  options.mesh_spacing = std::sqrt(x / 2000);
  const LoadedScene loaded = load_scene(own_file("a.obj", text), options);
  ASSERT_NEAR(static_cast<double>(loaded.scene.size()), 2000, 1);
  std::vector<double> found(10, 0);
  for (std::size_t i = 0; i < loaded.scene.size(); ++i) {
    const double at = world(loaded.scene, i).x();
    for (int s = 0; s < 10; ++s) found[s] += at >= edge[s] && at < edge[s + 1];
  }
  for (int s = 0; s < 10; ++s) EXPECT_NEAR(found[s], 2000 * (edge[s + 1] - edge[s]) / x, 2.0) << s;
}

TEST(Mesh, stratified_points_fill_a_plate_more_evenly_than_random_ones) {
  const std::string path = own_file("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  LoadOptions options;
  options.mesh_spacing = 0.01;
  const LoadedScene loaded = load_scene(path, options);
  EXPECT_EQ(loaded.report.triangles_read, 2u);
  std::array<double, 100> cells{};
  for (std::size_t i = 0; i < loaded.scene.size(); ++i) {
    const Eigen::Vector3d p = world(loaded.scene, i);
    cells[static_cast<int>(p.x() * 10) * 10 + static_cast<int>(p.y() * 10)] += 1;
  }
  double variance = 0;
  for (const double c : cells) variance += (c - 100) * (c - 100) / 100;
  EXPECT_LT(variance, 50);  // independent points: 100, with standard deviation 14
}

TEST(Mesh, the_seed_moves_the_surfels_and_threads_do_not) {
  const std::string path = own_file("a.obj", cube_obj());
  LoadOptions options;
  options.mesh_spacing = 0.05;
  options.threads = 1;
  const LoadedScene one = load_scene(path, options);
  for (const int threads : {2, 7}) {
    options.threads = threads;
    const LoadedScene many = load_scene(path, options);
    EXPECT_EQ(many.scene.point, one.scene.point);
    EXPECT_EQ(many.scene.normal, one.scene.normal);
  }
  options.seed = 2;
  EXPECT_NE(load_scene(path, options).scene.point, one.scene.point);
}

TEST(Mesh, inconsistent_winding_gives_normals_without_sides_unless_a_viewpoint_is_given) {
  const std::string path = own_file("a.obj", cube_obj(true));
  const LoadedScene loaded = load_scene(path);
  EXPECT_FALSE(loaded.scene.normals_oriented);
  EXPECT_TRUE(has_note(loaded.report, "3 of 18 shared edges"));
  LoadOptions options;
  options.viewpoint = Eigen::Vector3d(0.25, 0.5, 0.5);  // the middle: all faces are seen from inside
  const LoadedScene seen = load_scene(path, options);
  EXPECT_TRUE(seen.scene.normals_oriented);
  for (std::size_t i = 0; i < seen.scene.size(); ++i) {
    EXPECT_GT(seen.scene.normal[i].cast<double>().dot(*options.viewpoint - world(seen.scene, i)), 0);
  }
}

TEST(Mesh, a_closed_mesh_wound_inwards_is_noted_and_kept) {
  const LoadedScene loaded = load_scene(own_file("a.obj", cube_obj(false, true)));
  EXPECT_TRUE(loaded.scene.normals_oriented);
  EXPECT_TRUE(has_note(loaded.report, "normals point inwards"));
  EXPECT_FALSE(has_note(load_scene(own_file("b.obj", cube_obj())).report, "inwards"));
}

TEST(Mesh, vertex_normals_of_the_file_decide_the_side_and_are_interpolated) {
  // A roof whose vertex normals lean outwards; the winding says down, the normals up.
  const LoadedScene loaded = load_scene(own_file("a.obj",
                                                 "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn -0.6 0 0.8\nvn "
                                                 "0.6 0 0.8\nf 1//1 4//1 3//2\nf 1//1 3//2 2//2\n"));
  EXPECT_TRUE(loaded.scene.normals_oriented);
  for (std::size_t i = 0; i < loaded.scene.size(); ++i) {
    const double x = world(loaded.scene, i).x();
    const Eigen::Vector3d expected = Eigen::Vector3d(-0.6 + 1.2 * x, 0, 0.8).normalized();
    ASSERT_LT((loaded.scene.normal[i].cast<double>() - expected).norm(), 1e-5);
  }
}

TEST(Mesh, hard_edges_keep_one_normal_per_face) {
  // Two faces that share an edge, each with its own normal at the shared vertices.
  const LoadedScene loaded =
      load_scene(own_file("a.obj",
                          "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 0 1 1\nvn 0 0 1\nvn 1 0 0\n"
                          "f 1//1 2//1 3//1 4//1\nf 1//2 4//2 6//2 5//2\n"));
  EXPECT_EQ(loaded.report.points_read, 6u);
  for (std::size_t i = 0; i < loaded.scene.size(); ++i) {
    const bool floor = world(loaded.scene, i).z() == 0;
    ASSERT_EQ(loaded.scene.normal[i], floor ? Eigen::Vector3f(0, 0, 1) : Eigen::Vector3f(1, 0, 0));
  }
}

TEST(Mesh, degenerate_triangles_and_bad_corners_are_counted) {
  const LoadedScene loaded =
      load_scene(own_file("a.obj",
                          "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 2\nf 1 2 "
                          "99\nf 1 2\nf 1 2 5\nf -3 -2 1\n"));
  EXPECT_EQ(loaded.report.triangles_read, 7u);
  EXPECT_EQ(loaded.report.dropped_degenerate, 5u);
  EXPECT_EQ(loaded.report.dropped_not_finite, 1u);
  EXPECT_NEAR(total_area(loaded.scene), 0.5 + 1, 2e-6);  // the first, and the last, which counts from the end
}

std::string cube_ply(const std::string& format) {
  const bool ascii = format == "ascii", big = format == "binary_big_endian";
  std::ostringstream out;
  out.precision(17);
  out << "ply\nformat " << format << " 1.0\nelement vertex 8\nproperty double x\nproperty double y\n"
      << "property double z\nproperty uchar label\nelement face 6\nproperty uchar red\n"
      << "property list uchar uint vertex_indices\nend_header\n";
  for (int i = 0; i < 8; ++i) {
    for (const double c : {500000 + (i & 1 ? 0.5 : 0.0), i & 2 ? 4600001.0 : 4600000.0, i & 4 ? 1.0 : 0.0}) {
      if (ascii)
        out << c << ' ';
      else
        out << bytes_of(c, big);
    }
    out << (ascii ? "1\n" : "\x01");
  }
  const unsigned faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& face : faces) {
    out << (ascii ? "9 4" : "\x09\x04");
    for (const unsigned c : face) {
      if (ascii)
        out << ' ' << c;
      else
        out << bytes_of(c, big);
    }
    if (ascii) out << '\n';
  }
  return out.str();
}

TEST(Mesh, a_ply_of_quads_in_every_encoding_keeps_double_coordinates_and_labels) {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    LoadOptions options;
    options.mesh_spacing = 0.05;
    const LoadedScene loaded = load_scene(own_file("a.ply", cube_ply(format)), options);
    EXPECT_EQ(loaded.report.format, std::string("PLY ") + format + " mesh");
    EXPECT_EQ(loaded.report.triangles_read, 12u);
    EXPECT_EQ(loaded.scene.size(), 1600u);
    EXPECT_NEAR(total_area(loaded.scene), box_area, 1e-6 * box_area);
    EXPECT_EQ(loaded.scene.origin, Eigen::Vector3d(500000, 4600001, 1));  // 0.25 0.5 0.5 rounded, halves up
    EXPECT_EQ(loaded.scene.material[7], 1);
    EXPECT_FALSE(has_note(loaded.report, "inwards"));
    const Bounds box = bounds(loaded.scene);
    EXPECT_LT((box.min - Eigen::Vector3d(500000, 4600000, 0)).norm(), 1e-6);
    EXPECT_LT((box.max - Eigen::Vector3d(500000.5, 4600001, 1)).norm(), 1e-6);
  }
}

TEST(Mesh, a_binary_mesh_cut_off_anywhere_is_refused) {
  const std::string bytes = cube_ply("binary_little_endian");
  for (std::size_t length = bytes.size() - 120; length < bytes.size(); length += 3) {
    const std::string path = own_file("a.ply", bytes.substr(0, length));
    expect_error(ErrorKind::content, {path, "cut off"}, [&] { load_scene(path); });
  }
}

TEST(Mesh, stl_and_vtk_files_written_by_vtk_have_the_area_of_a_sphere) {
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(2);
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(64);
  vtkNew<vtkStripper> strips;
  strips->SetInputConnection(sphere->GetOutputPort());
  const auto check = [&](const std::string& path) {
    LoadOptions options;
    options.mesh_spacing = 0.05;
    const LoadedScene loaded = load_scene(path, options);
    EXPECT_NEAR(total_area(loaded.scene), 16 * M_PI, 0.005 * 16 * M_PI) << path;  // 64 facets: 1 - pi^2/(2 64^2) ...
    EXPECT_TRUE(loaded.scene.normals_oriented);
    for (std::size_t i = 0; i < loaded.scene.size(); ++i) {
      ASSERT_GT(loaded.scene.normal[i].cast<double>().dot(world(loaded.scene, i)), 1.9) << path;
    }
  };
  for (const bool binary : {false, true}) {
    const std::string stl = own_path("a.stl"), vtk = own_path("a.vtk"), vtp = own_path("a.vtp");
    vtkNew<vtkSTLWriter> stl_writer;
    stl_writer->SetFileName(stl.c_str());
    stl_writer->SetInputConnection(sphere->GetOutputPort());
    binary ? stl_writer->SetFileTypeToBinary() : stl_writer->SetFileTypeToASCII();
    stl_writer->Write();
    check(stl);
    vtkNew<vtkPolyDataWriter> vtk_writer;
    vtk_writer->SetFileName(vtk.c_str());
    vtk_writer->SetInputConnection(strips->GetOutputPort());
    binary ? vtk_writer->SetFileTypeToBinary() : vtk_writer->SetFileTypeToASCII();
    vtk_writer->Write();
    check(vtk);
    vtkNew<vtkXMLPolyDataWriter> vtp_writer;
    vtp_writer->SetFileName(vtp.c_str());
    vtp_writer->SetInputConnection(sphere->GetOutputPort());
    binary ? vtp_writer->SetDataModeToBinary() : vtp_writer->SetDataModeToAscii();
    vtp_writer->Write();
    check(vtp);
  }
}

TEST(Mesh, too_fine_a_spacing_is_refused_with_the_file) {
  LoadOptions options;
  options.mesh_spacing = 1e-6;
  expect_error(ErrorKind::content, {"a.obj: surfels 1e-06 m apart on", "at most 400000000", "give a wider spacing"},
               [&] { load_scene(own_file("a.obj", cube_obj()), options); });
  // A height field, which is sampled by another way.
  options.mesh_spacing = 1e-9;
  expect_error(ErrorKind::content, {"grid.xyz: surfels 1e-09 m apart on", "at most 400000000"},
               [&] { load_scene(own_file("grid.xyz", plate_text(12, 0.5)), options); });
}

}  // namespace
