// SPDX-License-Identifier: BSD-3-Clause
// Does what messages about meshes propose, and expects it to work.
#include <filesystem>
#include <regex>

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "scene_io/test_files.hpp"

namespace {

const std::string test_meshes = INSONIFY_TEST_MESHES;

std::string message_of(const std::string& path) {
  try {
    load_scene(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "read";
}

/// Returns a box of 1 x 2 x 3 m as one cell.
vtkNew<vtkUnstructuredGrid> box_grid() {
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 8; ++i)
    points->InsertNextPoint((i % 4 == 1 || i % 4 == 2) * 1.0, (i % 4 >= 2) * 2.0, (i >= 4) * 3.0);
  const vtkIdType corners[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, corners);
  return grid;
}

template <typename Writer>
std::string written(vtkDataObject* data, const std::string& name) {
  vtkNew<Writer> writer;
  writer->SetFileName(own_path(name).c_str());
  writer->SetInputData(data);
  writer->Write();
  return own_path(name);
}

/// Runs the command at the end of a message in the folder of the test. Returns false if Debian's Python has no VTK.
bool ran(const std::string& message) {
  const std::size_t begin = message.find("/usr/bin/python3 ");
  EXPECT_NE(begin, message.npos) << message;
  if (begin == message.npos) return false;
  const std::string folder = std::filesystem::path(own_path("x")).parent_path();
  const bool good = std::system(("cd '" + folder + "' && " + message.substr(begin)).c_str()) == 0;
  EXPECT_TRUE(good || std::system("/usr/bin/python3 -c 'import vtk'") != 0) << message;
  return good;
}

}  // namespace

TEST(Remedies, the_surface_of_a_grid_of_vtk_is_made_by_the_command_of_the_message) {
  const vtkNew<vtkUnstructuredGrid> grid = box_grid();
  for (const std::string& path :
       {written<vtkXMLUnstructuredGridWriter>(grid, "in.vtu"), written<vtkUnstructuredGridWriter>(grid, "in.vtk")}) {
    std::filesystem::remove(own_path("out.vtp"));
    const std::string message = message_of(path);
    if (!ran(message)) GTEST_SKIP() << "Debian's Python has no VTK (package python3-vtk9)";
    EXPECT_NEAR(area_of_mesh(load_scene(own_path("out.vtp"))), 2 * (1 * 2 + 2 * 3 + 1 * 3), 1e-6);
  }
  // A grid by a wrong name gets the same advice.
  const std::string renamed = own_path("renamed.vtp");
  std::filesystem::copy_file(own_path("in.vtu"), renamed);
  EXPECT_NE(message_of(renamed).find("no polydata; save its surface as polydata first"), std::string::npos);
}

TEST(Remedies, an_array_of_words_is_read_from_a_vtp) {
  vtkNew<vtkPoints> points;
  for (const double x : {0.0, 1.0, 2.0}) points->InsertNextPoint(x, x * x, 0);
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  const vtkIdType corners[3] = {0, 1, 2};
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(3, corners);
  data->SetPolys(cells);
  vtkNew<vtkStringArray> words;
  words->SetName("word");
  for (const char* word : {"one", "two", "three"}) words->InsertNextValue(word);
  data->GetPointData()->AddArray(words);
  EXPECT_NE(message_of(written<vtkPolyDataWriter>(data, "a.vtk")).find("save the file as .vtp"), std::string::npos);
  EXPECT_EQ(message_of(written<vtkXMLPolyDataWriter>(data, "a.vtp")), "read");
}

TEST(Remedies, compressed_gltf_is_read_when_it_is_unpacked) {
  for (const std::string name : {"wedge_draco", "wedge_meshopt"}) {
    const std::string message = message_of(test_meshes + "/" + name + ".glb");
    EXPECT_NE(message.find("npx @gltf-transform/cli copy in.glb out.glb"), std::string::npos) << message;
    const LoadedScene unpacked = load_scene(test_meshes + "/" + name + "_unpacked.glb");
    EXPECT_NEAR(area_of_mesh(unpacked), 36, 0.01);  // in steps of 4 m / 2^14
  }
}

// A file of each format under the name of another is read when it is renamed as the message says.
TEST(Remedies, files_of_another_format_are_read_when_they_are_renamed) {
  const std::string triangle = "0 0 0\n1 0 0\n0 1 0\n";
  const std::map<std::string, std::string> files = {
      {".ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
           triangle + "3 0 1 2\n"},
      {".pcd",
       "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\n"
       "POINTS 3\nDATA ascii\n" +
           triangle},
      {".stl",
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
       "endsolid a\n"},
      {".vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n" + triangle +
                   "POLYGONS 1 4\n3 0 1 2\n"},
      {".vtp",
       "<?xml version=\"1.0\"?>\n<VTKFile version=\"0.1\" type=\"PolyData\">\n<PolyData>\n"
       "<Piece NumberOfPoints=\"3\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
       "NumberOfPolys=\"1\">\n<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">" +
           triangle +
           "</DataArray></Points>\n<Polys><DataArray type=\"Int64\" Name=\"connectivity\" "
           "format=\"ascii\">0 1 2</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3"
           "</DataArray></Polys>\n</Piece></PolyData></VTKFile>\n"},
      {".glb", file_bytes(test_meshes + "/wedge.glb")}};
  for (const auto& [extension, bytes] : files)
    for (const auto& [wrong, other] : files) {
      if (wrong == extension) continue;
      const std::string message = message_of(own_file("a" + wrong, bytes));
      std::smatch found;
      ASSERT_TRUE(std::regex_search(message, found, std::regex("rename it to (\\.[a-z]+)"))) << extension << message;
      EXPECT_EQ(message_of(own_file("a" + found[1].str(), bytes)), "read") << message;
    }
}
