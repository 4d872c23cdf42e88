// SPDX-License-Identifier: BSD-3-Clause
#include <vtkNew.h>
#include <vtkSphereSource.h>
#include <vtkXMLPolyDataWriter.h>

#include "core/random.hpp"
#include "files/peak_memory.hpp"
#include "scene_io/describe_file.hpp"
#include "scene_io/save_cloud.hpp"
#include "scene_io/test_files.hpp"
#include "support/test.hpp"
#include "tool/command/reader_server.hpp"

namespace {

/// Expects load_scene and describe_file to refuse a file with the same message.
void expect_refused(const std::string& path, ErrorKind kind, std::vector<std::string> parts) {
  parts.push_back(path);
  expect_error(kind, parts, [&] { load_scene(path); });
  expect_error(kind, parts, [&] { describe_file(path); });
}

void expect_bad(const std::string& path, const std::vector<std::string>& parts) {
  expect_refused(path, ErrorKind::content, parts);
}

SceneCloud small_scene() {
  SceneCloud scene;
  for (int i = 0; i < 10; ++i) add_surfel(scene, {i * 0.5, i % 3 * 1.0, 0}, {0, 0, 1}, 0.25);
  return scene;
}

TEST(BadFile, missing_files_and_folders_are_file_errors) {
  expect_refused(own_path("none.ply"), ErrorKind::file, {"no such file", "check the path"});
  expect_refused(::testing::TempDir(), ErrorKind::file, {"is a folder"});
}

TEST(BadFile, empty_and_unknown_files_say_what_was_expected) {
  expect_bad(own_file("a.ply", ""), {"empty (0 bytes)"});
  expect_bad(own_file("a.blend", "BLENDER"),
             {"unknown extension '.blend'", ".pcd .ply .obj", scene_extensions(), "text beginning with 'BLENDER'"});
  expect_bad(own_file("a.e57", "ASTM-E57"), {"an E57 file, which is not read", "docs/scene-files.md has the command"});
  const bool meshes = scene_extensions().find(".wrl") != std::string::npos;
  expect_bad(own_file("a.wrl", "#VRML V1.0 ascii"),
             {meshes ? "expected '#VRML V2.0'" : "a VRML file, which is not read"});
  const bool unpacks = scene_extensions().find(".laz") != std::string::npos;
  expect_bad(own_file("a.laz", "LASF...."), {unpacks ? "cut off" : "a LAZ file, which is not read"});
  expect_bad(own_file("noextension", "ply\n"), {"unknown extension ''", "rename it to .ply"});
}

TEST(BadFile, a_file_of_another_format_than_its_name_says_is_named) {
  const std::string text = "0 0 0\n1 0 0\n";
  expect_bad(own_file("a.pcd", text), {"not a PCD file", "VERSION", "text beginning with '0 0 0'", ".xyz"});
  expect_bad(own_file("b.ply", text), {"not a PLY file", "expected 'ply'", "text beginning with '0 0 0'"});
  expect_bad(own_file("c.pcd", "ply\nformat ascii 1.0\n"), {"not a PCD file", "rename it to .ply"});
  expect_bad(own_file("d.ply", "# .PCD v0.7\n"), {"not a PLY file", "rename it to .pcd"});
  expect_bad(own_file("d.ply", "\x89HDF\r\n\x1a\n"), {"not a PLY file", "rename it to .tiles"});
  expect_bad(own_file("e.obj", text), {"not an OBJ file", "'v x y z'"});
  expect_bad(own_file("f.stl", text), {"not an STL file", "solid"});
  expect_bad(own_file("g.vtk", text), {"not a legacy VTK file", "# vtk DataFile"});
  expect_bad(own_file("h.vtp", text), {"not a VTK XML file", "<VTKFile"});
  expect_bad(own_file("i.xyz", std::string("\0\1\2\3", 4)), {"not a text file", "binary data"});
  expect_bad(own_file("j.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 0 float\n"),
             {"UNSTRUCTURED_GRID", "expected DATASET POLYDATA", "Extract Surface"});
}

TEST(BadFile, a_binary_cloud_cut_off_anywhere_is_refused_with_both_counts) {
  for (const char* name : {"a.ply", "a.pcd"}) {
    const std::string whole = own_path(name);
    save_scene(whole, small_scene());
    const std::string bytes = file_bytes(whole);
    // The last 36 or 38 bytes are one row: with all but one byte of it, 9 of 10 rows are complete.
    expect_bad(own_file(std::string("tail_") + name, bytes.substr(0, bytes.size() - 1)),
               {"cut off", "announces 10", std::string(name) == "a.ply" ? "holds 9" : "holds 359"});
    for (std::size_t length = 1; length < bytes.size(); length += 7) {
      const std::string cut = own_file(std::string("cut_") + name, bytes.substr(0, length));
      expect_error(ErrorKind::content, {cut}, [&] { load_scene(cut); });
    }
  }
}

TEST(BadFile, a_compressed_pcd_cut_off_or_damaged_is_refused) {
  const std::string header =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4\nHEIGHT 1\nPOINTS 4\nDATA "
      "binary_compressed\n";
  expect_bad(own_file("a.pcd", header + "abc"), {"cut off", "announces 4 points"});
  expect_bad(own_file("b.pcd", header + bytes_of(100u) + bytes_of(48u) + "abc"), {"cut off", "100 bytes", "holds 3"});
  expect_bad(own_file("c.pcd", header + bytes_of(3u) + bytes_of(96u) + "abc"), {"48 bytes", "96"});
  expect_bad(own_file("d.pcd", header + bytes_of(3u) + bytes_of(48u) + "abc"), {"cannot unpack", "damaged"});
}

TEST(BadFile, numbers_that_would_be_misread_are_named_by_line) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nproperty uchar "
      "label\nend_header\n";
  expect_bad(own_file("a.ply", ply + "1 2 3 0\n4 zero 6 0\n"), {":10:", "expected a number", "'zero'"});
  expect_bad(own_file("b.ply", ply + "1 2 3 300\n4 5 6 0\n"), {":9:", "fits uint8", "'300'"});
  expect_bad(own_file("c.ply", ply + "1 2 3 0.5\n4 5 6 0\n"), {":9:", "fits uint8", "'0.5'"});
  const std::string pcd = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\n";
  expect_bad(own_file("d.pcd", pcd + "DATA ascii\n1 2 3\n4 zero 6\n"), {":10:", "expected a number", "'zero'"});
  expect_bad(own_file("e.pcd", pcd + "DATA ascii\n1 2 3\n \n4 5 6\n"), {":10:", "expected 3 numbers", "found 0"});
}

TEST(BadFile, a_compressed_pcd_with_padding_is_refused) {
  expect_bad(own_file("a.pcd",
                      "FIELDS x y z _\nSIZE 4 4 4 1\nTYPE F F F U\nCOUNT 1 1 1 4\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA "
                      "binary_compressed\n12345678"),
             {"padding fields '_'", "DATA binary"});
}

TEST(BadFile, text_lines_are_named_by_number) {
  expect_bad(own_file("a.xyz", "0 0 0\n1 0\n"), {":2:", "expected 3 columns", "found 2"});
  expect_bad(own_file("b.xyz", "0 0 0\n1 zero 0\n"), {":2:", "'zero'", "not a number"});
  expect_bad(own_file("c.csv", "x;y;z\n1,5,2;2,5;3,5\n"), {":2:", "'1,5,2'", "not a number"});
  expect_bad(own_file("d.xyz", "5\n0 0 0\n1 0 0\n"), {"announces 5 points, found 2"});
  expect_bad(own_file("e.xyz", "# nothing\n"), {"holds no point"});
  expect_bad(own_file("f.csv", "x,y,z,label\n1,2,3\n"), {":2:", "expected 4 columns", "found 3"});
  expect_bad(own_file("g.obj", "v 0 0 0\nv 1 0\n"), {":2:", "three numbers"});
  expect_bad(own_file("h.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 a\n"), {":4:", "corner", "'a'"});
}

TEST(BadFile, wrong_headers_are_named) {
  const std::string pcd = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n";
  expect_bad(own_file("a.pcd", pcd + "POINTS 3\nDATA ascii\n"), {"POINTS 3", "WIDTH times HEIGHT"});
  expect_bad(own_file("b.pcd", pcd + "POINTS 2\nDATA zipped\n"), {"DATA zipped", "binary_compressed"});
  expect_bad(own_file("c.pcd", pcd + "POINTS 2\nDATA ascii\n1 2 3\n"), {"cut off"});
  expect_bad(own_file("d.pcd", pcd + "POINTS 2\nDATA ascii\n1 2 3\n1 2\n"), {":11:", "expected 3 numbers", "found 2"});
  expect_bad(own_file("e.pcd", pcd), {"cut off inside the PCD header", "DATA"});
  expect_bad(own_file("f.pcd", "FIELDS x y z\nSIZE 4 4\n"), {":2:", "one entry per field"});
  expect_bad(
      own_file("g.pcd", "FIELDS a b\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2\n"),
      {"expected fields x y z", "'a b'"});
  expect_bad(own_file("h.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\nend_header\n"),
             {":4:", "unknown PLY number type 'real'"});
  expect_bad(own_file("i.ply", "ply\nformat ascii 1.0\nelement vertex 1\n"),
             {"cut off inside the PLY header", "end_header"});
  expect_bad(own_file("j.ply", "ply\nformat ascii 1.0\nelement face 0\nend_header\n"), {"no 'vertex' element"});
  expect_bad(own_file("k.ply", "ply\nelement vertex 0\nend_header\n"), {"no 'format' line"});
  expect_bad(own_file("l.ply", "ply\nformat ascii 1.0\ncomment insonify scene 9\nend_header\n"),
             {"insonify scene 9", "save the scene again"});
}

TEST(BadFile, meshes_cut_off_are_refused) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
  expect_bad(own_file("a.ply", ply + "3 0 1 2\n"), {"cut off", "2 face rows, found 1"});
  expect_bad(own_file("b.ply", ply + "3 0 1 2\n3 0 1\n"), {":14:", "expected a number in this face row"});
  const std::string stl = std::string(80, ' ') + bytes_of(2u) + std::string(50, '\0');
  expect_bad(own_file("c.stl", stl), {"cut off", "2 triangles, 184 bytes", "holds 134"});
  expect_bad(own_file("d.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"), {"cut off", "endsolid"});
  expect_bad(own_file("e.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 100 float\n0 0 0 1 0"),
             {"POINTS announces 100 x 3 numbers", "cut off"});
}

TEST(BadFile, a_cut_off_vtp_is_refused_and_nothing_is_printed) {
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkXMLPolyDataWriter> writer;
  const std::string whole = own_path("a.vtp");
  writer->SetFileName(whole.c_str());
  writer->SetInputConnection(sphere->GetOutputPort());
  writer->SetDataModeToAscii();
  writer->Write();
  const std::string bytes = file_bytes(whole);
  ::testing::internal::CaptureStderr();
  expect_bad(own_file("cut.vtp", bytes.substr(0, bytes.size() / 2)), {"VTK cannot read it", "cut off"});
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(BadFile, counts_of_legacy_vtk_are_held_against_the_file) {
  const std::string head =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n";
  forget_peak_memory();
  for (const auto& [rest, part] : std::vector<std::pair<std::string, std::string>>{
           {"POLYGONS 1 4\n999999999 0 1 2\n", "polygons announces 1 cells in 4 numbers"},
           {"POLYGONS 1 4\n-3 0 1 2\n", "its cells have other lengths"},
           {"POLYGONS 2 4\n3 0 1 2\n", "its cells have other lengths"},
           {"TRIANGLE_STRIPS 1 4\n5 0 1 2\n", "its cells have other lengths"},
           {"POLYGONS 2 8\n3 0 1 2\n5 0 1 2\n", "its cells have other lengths"},
           {"POINT_DATA 3\nSCALARS label int 1000000000\nLOOKUP_TABLE default\n1 2 3\n", "label announces"},
           {"POINT_DATA 3\nSCALARS label int x\nLOOKUP_TABLE default\n1 2 3\n", "'x' components"},
           {"POINT_DATA 3\nFIELD f 1\na 1000000 18446744073709551615 int\n1\n", "array a announces"},
           {"POINT_DATA 3\nFIELD f 2\na 1 1 int\n1\n", "announces 2 arrays, found 1"},
           {"POINT_DATA 3\nSCALARS label string\nLOOKUP_TABLE default\na\nb\nc\n", "type 'string', expected numbers"},
           {"POLYGONS 1 4\n3 0 4294967296 2\n", "number 2 is '4294967296'"},  // which crashes VTK
           {"POLYGONS 1 4\n3 0 1e308 2\n", "number 2 is '1e308'"},
           {"POINT_DATA 3\nSCALARS label unsigned_int\nLOOKUP_TABLE default\n4294967295 1.5 3\n",
            "3 numbers of type unsigned_int; number 1 is '1.5'"},
           {"POINTZ 3 float\n", "'pointz' is no part"}})
    expect_bad(own_file("a.vtk", head + rest), {part});
  const std::string modern = replaced(head, "3.0", "5.1");
  expect_bad(own_file("m.vtk", modern + "POLYGONS 2 3\nOFFSETS vtktypeint64\n0 99\nCONNECTIVITY vtktypeint64\n0 1 2\n"),
             {"OFFSETS that do not fit"});
  for (const char* version : {"inf", "5>1"})  // which is the old format to VTK
    expect_bad(own_file("v.vtk", replaced(modern, "5.1", version) +
                                     "POLYGONS 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n0 1 2\n"),
               {"number 0 is 'OFFSETS'"});
  std::string binary = replaced(head.substr(0, head.find("0 0 0 1")), "ASCII", "BINARY");
  binary += std::string(36, '\0') + "\nPOLYGONS 1 4\n" + std::string("\0\0\0\x05\0\0\0\0\0\0\0\1\0\0\0\2", 16) + "\n";
  expect_bad(own_file("b.vtk", binary), {"its cells have other lengths"});
  expect_bad(own_file("s.vtk", replaced(binary.substr(0, 100), "POINTS 3", "POINTS 9")),
             {"POINTS announces 27 numbers"});
  EXPECT_LT(peak_memory_mib(), 500);
}

TEST(BadFile, counts_of_vtp_are_held_against_the_file) {
  const auto vtp = [](const std::string& points, const std::string& components, const std::string& offset) {
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
           "byte_order=\"LittleEndian\">\n<PolyData>\n"
           "<Piece NumberOfPoints=\"" +
           points +
           "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
           "NumberOfPolys=\"1\">\n<Points><DataArray type=\"Float32\" NumberOfComponents=\"" +
           components +
           "\" format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points>\n<Polys><DataArray type=\"Int64\" "
           "Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray><DataArray type=\"Int64\" Name=\"offsets\" "
           "format=\"ascii\">" +
           offset + "</DataArray></Polys>\n</Piece></PolyData></VTKFile>\n";
  };
  const tool::ReaderServer server;  // VTK takes memory for what offsets announce
  EXPECT_EQ(describe_file(own_file("good.vtp", vtp("3", "3", "3"))).points, 3u);
  forget_peak_memory();
  for (const auto& [text, part] : std::vector<std::pair<std::string, std::string>>{
           {vtp("4", "3", "3"), "ends before the numbers that are announced"},
           {vtp("3000000000", "3", "3"), "NumberOfPoints = 3000000000 is more than the file can hold"},
           {vtp("-3", "3", "3"), "NumberOfPoints = -3"},
           {vtp("3", "2000000000", "3"), "announces more numbers than the file can hold"},
           {vtp("3", "3", "4"), ""},
           {vtp("3", "3", "4000000000"), ""},
           {vtp("3", "3", "-5"), ""}})
    expect_bad(own_file("a.vtp", text), {part});
  EXPECT_LT(peak_memory_mib(), 500);
}

TEST(BadFile, arrays_in_a_vtp_that_are_cut_short_are_refused) {
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(own_path("whole.vtp").c_str());
  writer->SetInputConnection(sphere->GetOutputPort());
  for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended}) {
    writer->SetDataMode(mode);
    writer->Write();
    const std::string bytes = file_bytes(own_path("whole.vtp"));
    EXPECT_EQ(describe_file(own_path("whole.vtp")).points, 50u);
    // 20 characters of an array less, in an XML that is whole.
    const std::size_t array = bytes.find(mode == vtkXMLWriter::Appended ? "</AppendedData>" : "</DataArray>");
    expect_bad(own_file("cut.vtp", bytes.substr(0, array - 40) + bytes.substr(array)), {"VTK cannot read it"});
  }
}

TEST(BadFile, clouds_without_a_usable_point_are_refused) {
  expect_error(ErrorKind::content, {"no usable point", "none with finite"},
               [] { load_scene(own_file("a.xyz", "nan 0 0\n0 inf 0\n")); });
  expect_error(ErrorKind::content, {"no usable point", "2 points, 1 of them with coordinates beyond 1e9 m"},
               [] { load_scene(own_file("far.xyz", "2e9 0 0\n0 inf 0\n")); });
  expect_error(ErrorKind::content, {"no usable point", "at least 3"},
               [] { load_scene(own_file("b.xyz", "0 0 0\n1 0 0\n")); });
  expect_error(ErrorKind::content, {"no usable triangle"},
               [] { load_scene(own_file("c.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")); });
}

TEST(BadOption, values_that_no_file_can_satisfy_are_argument_errors) {
  const std::string path = own_file("a.xyz", plate_text(4, 0.5));
  LoadOptions options;
  options.meaning.unit = 0;
  expect_error(ErrorKind::argument, {"unit = 0 m, must be > 0"}, [&] { load_scene(path, options); });
  options = {};
  options.mesh_spacing = -1;
  expect_error(ErrorKind::argument, {"mesh_spacing = -1 m"}, [&] { load_scene(path, options); });
  options = {};
  options.normal_neighbours = 2;
  expect_error(ErrorKind::argument, {"normal_neighbours = 2", "at least 3"}, [&] { load_scene(path, options); });
  options = {};
  options.material = 3;
  expect_error(ErrorKind::argument, {"material = 3", "number of materials, 1"}, [&] { load_scene(path, options); });
}

/// Returns small valid files of all formats parsed by insonify or PCL.
std::vector<std::pair<std::string, std::string>> good_files() {
  const std::string saved = own_path("good.ply"), saved_pcd = own_path("good.pcd");
  save_scene(saved, small_scene());
  save_scene(saved_pcd, small_scene());
  const std::string face =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n";
  std::string binary = face.substr(0, face.find("0 0 0"));
  binary.replace(binary.find("ascii"), 5, "binary_big_endian");
  for (const float c : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f}) binary += bytes_of(c, true);
  for (const auto& [a, b, c] : {std::array{0, 1, 2}, std::array{1, 3, 2}}) {
    binary += '\3';
    for (const int corner : {a, b, c}) binary += bytes_of(corner, true);
  }
  const std::string pcd =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\n";
  // LZF: a literal run of 32 + 16 bytes.
  const std::string points(48, '\0');
  const std::string compressed = pcd + "DATA binary_compressed\n" + bytes_of(50u) + bytes_of(48u) + "\x1f" +
                                 points.substr(0, 32) + "\x0f" + points.substr(0, 16);
  return {{"a.ply", file_bytes(saved)},
          {"b.pcd", file_bytes(saved_pcd)},
          {"c.ply", face},
          {"d.ply", binary},
          {"e.pcd", pcd + "DATA ascii\n" + plate_text(2, 1)},
          {"f.pcd", compressed},
          {"g.xyz", plate_text(3, 1)},
          {"h.csv", "x,y,z,label\n0,0,0,0\n1,0,0,0\n0,1,0,1\n1,1,0,1\n"},
          {"i.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n"}};
}

TEST(BadFile, damaged_bytes_give_an_error_or_a_valid_scene_and_nothing_is_printed) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  int refused = 0, read = 0;
  for (const auto& [name, good] : good_files()) {
    for (std::uint64_t trial = 0; trial < 300; ++trial) {
      std::string bytes = good;
      const auto random = random_uniform(1, RandomStage::scene_points, {.first = trial, .second = good.size()});
      const std::size_t at = static_cast<std::size_t>(random[0] * static_cast<double>(bytes.size()));
      if (trial % 3 == 0) bytes[at] = static_cast<char>(random[1] * 256);
      if (trial % 3 == 1) bytes.erase(at, 1 + static_cast<std::size_t>(random[1] * 4));
      const char drawn = "0123456789-. \n"[static_cast<std::size_t>(random[1] * 14)];
      if (trial % 3 == 2) bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), drawn);
      const std::string path = own_file(name, bytes);
      try {
        LoadOptions options;
        options.mesh_spacing = 0.5;
        require_valid(load_scene(path, options).scene, "test");
        ++read;
      } catch (const Error& error) {
        // A mesh with a coordinate of 1e8 needs too many surfels: the only error attributed to the option.
        EXPECT_TRUE(error.kind() == ErrorKind::content || error.kind() == ErrorKind::argument) << error.what();
        EXPECT_GT(std::string(error.what()).size(), path.size());
        ++refused;
      }
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(refused, 300);
  EXPECT_GT(read, 300);
}

}  // namespace
