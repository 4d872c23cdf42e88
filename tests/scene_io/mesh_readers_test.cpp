// SPDX-License-Identifier: BSD-3-Clause
// Meshes as programs write them: texts of STL and OBJ, strips, lists and orders of PLY; against VTK's readers.
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>

#include "scene_io/test_files.hpp"

namespace {

const std::string square_facets =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 -5\nvertex 4 0 -5\nvertex 4 3 -5\nendloop\nendfacet\n"
    "facet normal 0 0 1\nouter loop\nvertex 0 0 -5\nvertex 4 3 -5\nvertex 0 3 -5\nendloop\nendfacet\n";

void expect_square(const LoadedScene& loaded, const std::string& what) {
  ASSERT_TRUE(loaded.mesh) << what;
  EXPECT_NEAR(area_of_mesh(loaded), 12, 1e-6) << what;
  EXPECT_EQ(loaded.mesh->point.size(), 4U) << what;
}

std::string in_upper_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string with_crlf(const std::string& text) {
  std::string crlf;
  for (const char c : text) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  return crlf;
}

TEST(MeshReaders, stl_texts_of_all_programs_are_read) {
  const std::string plain = "solid bed\n" + square_facets + "endsolid bed\n", name(400, 'x');
  for (const std::string& text :
       {plain, "\xef\xbb\xbf" + plain, " " + plain, "\n" + plain, "\r\n\t" + plain, in_upper_case(plain),
        with_crlf(plain), "solid\n" + square_facets + "endsolid",
        "solid " + name + "\n" + square_facets + "endsolid " + name + "\n",
        "solid facet vertex\n" + square_facets + "end solid\n\n", "Solid a\n" + square_facets + "EndSolid a"})
    expect_square(load_scene(own_file("a.stl", text)), text.substr(0, 40));
  // Two solids in one file.
  expect_square(load_scene(own_file("a.stl", "solid a\n" + square_facets.substr(0, square_facets.size() / 2) +
                                                 "endsolid a\nsolid b\n" +
                                                 square_facets.substr(square_facets.size() / 2) + "endsolid b\n")),
                "two solids");
}

TEST(MeshReaders, stl_texts_keep_coordinates_of_a_map) {
  std::string text = "solid a\n" + square_facets + "endsolid a\n";
  for (std::size_t at = 0; (at = text.find("vertex ", at)) != text.npos; at += 7) text.insert(at + 7, "50000");
  const LoadedScene loaded = load_scene(own_file("a.stl", text));  // 500000 to 500004
  EXPECT_NEAR(area_of_mesh(loaded), 12, 1e-6);
  EXPECT_GT(loaded.mesh->origin.x(), 500000);
}

TEST(MeshReaders, binary_stl_is_known_by_its_size) {
  std::string facets;
  for (const auto& facet : {std::vector<float>{0, 0, 1, 0, 0, -5, 4, 0, -5, 4, 3, -5},
                            std::vector<float>{0, 0, 1, 0, 0, -5, 4, 3, -5, 0, 3, -5}}) {
    for (const float number : facet) facets += bytes_of(number);
    facets += "\x1f\x7c";  // a colour
  }
  for (std::string head : {"solid made by a program", "", "COLOR=ABCD", " solid"}) {
    head.resize(80, head.empty() ? '\0' : ' ');
    expect_square(load_scene(own_file("a.stl", head + bytes_of(2U) + facets)), head);
    expect_error(ErrorKind::content, {"a.stl"},
                 [&] { load_scene(own_file("a.stl", head + bytes_of(2U) + facets.substr(0, 99))); });
  }
  expect_square(load_scene(own_file("a.stl", std::string(80, '\0') + bytes_of(2U) + facets + "rest")), "a longer file");
}

TEST(MeshReaders, stl_texts_that_are_damaged_are_refused_by_line) {
  const std::string plain = "solid bed\n" + square_facets;
  expect_error(ErrorKind::content, {"a.stl", "cut off", "endsolid"}, [&] { load_scene(own_file("a.stl", plain)); });
  std::string letter = plain + "endsolid\n";
  letter.replace(letter.find("4 0 -5"), 1, "a");
  expect_error(ErrorKind::content, {"a.stl:5:", "expected three numbers, found 'a'"},
               [&] { load_scene(own_file("a.stl", letter)); });
  expect_error(ErrorKind::content, {"a.stl:2:", "expected facet", "found 'facit'"},
               [&] { load_scene(own_file("a.stl", "solid a\nfacit normal 0 0 1\nendsolid\n")); });
}

TEST(MeshReaders, obj_lines_go_on_behind_a_backslash_and_end_at_a_comment) {
  const std::string corners = "\xef\xbb\xbfv 0 0 -5 # first\nv 4 0 -5\nv 4 3 -5\nv 0 3 -5\n";
  for (const std::string& face :
       {std::string("f 1 2 3 4"), std::string("f 1 2 \\\n3 4"), std::string("f 1 \\\n 2 \\\n 3 4"),
        std::string("f 1 2 3 4 # quay"), std::string("f 1 2 3 4#quay"), std::string("f -4 -3 -2 -1"),
        std::string("f 1// 2// 3// 4//"), std::string("  f 1/9 2/9 3/9 4/9"), std::string("f 1 2 3\\ \n4")})
    for (const bool crlf : {false, true}) {
      const std::string text = corners + "# from C:\\beds\\\n" + face + "\n";
      expect_square(load_scene(own_file("a.obj", crlf ? with_crlf(text) : text)), face);
    }
}

/// A PLY of a grid of 3 x 4 points, 1 m apart; its numbers are text, or binary.
struct PlyMaker {
  std::string format, extra{};  ///< extra: a list of the vertices
  std::string header{}, body{};

  template <typename Number>
  void put(Number number) {
    if (format == "ascii")
      body += (body.empty() || body.back() == '\n' ? "" : " ") + std::to_string(number);
    else
      body += bytes_of(number, format == "binary_big_endian");
  }
  void end_row() { body += format == "ascii" ? "\n" : ""; }

  void add_vertices() {
    header += "element vertex 12\nproperty float x\n" + extra + "property float y\nproperty float z\n";
    for (int i = 0; i < 12; ++i) {
      put(static_cast<float>(i % 4));
      if (!extra.empty()) {
        put(static_cast<unsigned char>(i % 3));
        for (int k = 0; k < i % 3; ++k) put(static_cast<float>(100 + k));
      }
      put(static_cast<float>(i / 4));
      put(-5.0F);
      end_row();
    }
  }
  template <typename Count>
  void add_lists(const std::string& element, const std::string& types, const std::vector<std::vector<int>>& lists) {
    header +=
        "element " + element + " " + std::to_string(lists.size()) + "\nproperty list " + types + " vertex_indices\n";
    for (const std::vector<int>& list : lists) {
      put(static_cast<Count>(list.size()));
      for (const int corner : list) put(corner);
      end_row();
    }
  }
  LoadedScene load() const {
    return load_scene(own_file("a.ply", "ply\nformat " + format + " 1.0\n" + header + "end_header\n" + body));
  }
};

const std::vector<const char*> ply_formats = {"ascii", "binary_little_endian", "binary_big_endian"};

TEST(MeshReaders, strips_of_a_ply_end_at_minus_one) {
  for (const char* format : ply_formats) {
    PlyMaker maker{format};
    maker.add_vertices();
    maker.add_lists<int>("tristrips", "int int", {{4, 0, 5, 1, 6, 2, 7, 3, -1, 8, 4, 9, 5, 10, 6, 11, 7}});
    const LoadedScene loaded = maker.load();
    ASSERT_TRUE(loaded.mesh) << format;
    EXPECT_EQ(loaded.mesh->triangle.size(), 12U);
    EXPECT_NEAR(area_of_mesh(loaded), 6, 1e-6);
    EXPECT_FALSE(has_note(loaded.report, "wound"));
    for (std::size_t t = 0; t < 12; ++t) {
      const auto [a, b, c] = corners_of(*loaded.mesh, t);
      EXPECT_NEAR((b - a).cross(c - a).z(), 1, 1e-6) << format << ' ' << t;
    }
  }
}

TEST(MeshReaders, lists_of_the_vertices_of_a_ply_are_left_out_with_a_note) {
  for (const char* format : ply_formats) {
    PlyMaker maker{format, "property list uchar float texture\n"};
    maker.add_vertices();
    maker.add_lists<unsigned char>("face", "uchar int", {{0, 1, 5, 4}, {1, 2, 6}});
    const LoadedScene loaded = maker.load();
    ASSERT_TRUE(loaded.mesh) << format;
    EXPECT_NEAR(area_of_mesh(loaded), 1.5, 1e-6);
    EXPECT_TRUE(has_note(loaded.report, "the lists 'texture' of the vertices are not read"));
    PlyMaker cloud{format, "property list uchar float texture\n"};
    cloud.add_vertices();
    EXPECT_EQ(cloud.load().scene.size(), 12U);
  }
}

TEST(MeshReaders, elements_of_a_ply_may_stand_in_any_order) {
  for (const char* format : ply_formats) {
    PlyMaker maker{format};
    maker.add_lists<unsigned short>("face", "ushort int", {{0, 1, 5, 4}, {0, 1, 99}});
    maker.add_lists<unsigned char>("parts", "uchar int", {{7}, {7, 8}});
    maker.add_vertices();
    const LoadedScene loaded = maker.load();
    EXPECT_NEAR(area_of_mesh(loaded), 1, 1e-6) << format;
    EXPECT_EQ(loaded.report.dropped_degenerate, 1U);
  }
}

/// Returns the box of the triangles.
Bounds bounds_of_mesh(const LoadedScene& loaded) {
  Bounds box{Eigen::Vector3d::Constant(1e9), Eigen::Vector3d::Constant(-1e9)};
  for (std::size_t t = 0; t < loaded.mesh->triangle.size(); ++t)
    for (const Eigen::Vector3d& corner : corners_of(*loaded.mesh, t)) {
      box.min = box.min.cwiseMin(loaded.mesh->origin + corner);
      box.max = box.max.cwiseMax(loaded.mesh->origin + corner);
    }
  return box;
}

TEST(MeshReaders, bounds_equal_those_of_the_readers_of_vtk) {
  const std::string obj = own_file("a.obj", "v 1 2 3\nv 4 2 3.5\nv 4 6 -7\nv 1 6.25 -7\nf 1 2 3 4\n"),
                    stl = own_file("a.stl", "solid bed\n" + square_facets + "endsolid bed\n");
  const auto compare = [](auto* reader, const std::string& path) {
    reader->SetFileName(path.c_str());
    reader->Update();
    const double* of_vtk = vtkPolyData::SafeDownCast(reader->GetOutputDataObject(0))->GetBounds();
    const Bounds box = bounds_of_mesh(load_scene(path));
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(box.min[axis], of_vtk[2 * axis], 1e-6) << path;
      EXPECT_NEAR(box.max[axis], of_vtk[2 * axis + 1], 1e-6) << path;
    }
  };
  compare(vtkNew<vtkOBJReader>().Get(), obj);
  compare(vtkNew<vtkSTLReader>().Get(), stl);
}

}  // namespace
