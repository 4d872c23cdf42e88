// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/io/pcd_io.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkXMLPolyDataWriter.h>

#include "scene_io/test_files.hpp"

namespace {

/// Twelve points with normals, areas, labels and ids; every number is a multiple of 1/64, so that all formats
/// store it exactly, even for distant points.
struct Sample {
  std::vector<Eigen::Vector3d> position, normal;
  std::vector<double> area;
  std::vector<std::uint32_t> label, id;
};

Sample sample(const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  Sample s;
  for (int i = 0; i < 12; ++i) {
    s.position.push_back(shift + Eigen::Vector3d(i / 4.0, (i % 3) / 2.0, -i / 64.0));
    s.normal.push_back(i % 2 ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(0, -1, 0));
    s.area.push_back(0.25 + i / 64.0);
    s.label.push_back(static_cast<std::uint32_t>(i % 3));
    s.id.push_back(static_cast<std::uint32_t>(100 - i));
  }
  return s;
}

void expect_same(const Sample& s, const LoadedScene& loaded, bool with_columns = true) {
  ASSERT_EQ(loaded.scene.size(), s.position.size());
  EXPECT_EQ(loaded.report.points_read, s.position.size());
  EXPECT_FALSE(loaded.report.normals_estimated);
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    EXPECT_EQ(world(loaded.scene, i), s.position[i]) << i;
    EXPECT_EQ(loaded.scene.normal[i].cast<double>(), s.normal[i]) << i;
    if (!with_columns) continue;
    EXPECT_EQ(loaded.scene.area[i], s.area[i]) << i;
    EXPECT_EQ(loaded.scene.material[i], s.label[i]) << i;
    EXPECT_EQ(loaded.scene.id[i], s.id[i]) << i;
  }
  EXPECT_EQ(loaded.report.materials_found, with_columns);
  EXPECT_EQ(loaded.report.areas_estimated, !with_columns);
}

enum class Order { ascii, little, big };

std::string ply_bytes(const Sample& s, Order order, bool wide) {
  const char* formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  const std::string real = wide ? "double" : "float";
  std::ostringstream out;
  out.precision(17);
  out << "ply\nformat " << formats[static_cast<int>(order)] << " 1.0\ncomment by a test\nelement vertex "
      << s.position.size() << "\nproperty uchar spare\n";
  for (const char* name : {"x", "y", "z"}) out << "property " << real << ' ' << name << '\n';
  for (const char* name : {"nx", "ny", "nz", "area"}) out << "property " << real << ' ' << name << '\n';
  out << "property short label\nproperty int id\nend_header\n";
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    std::vector<double> reals(s.position[i].data(), s.position[i].data() + 3);
    reals.insert(reals.end(), s.normal[i].data(), s.normal[i].data() + 3);
    reals.push_back(s.area[i]);
    if (order == Order::ascii) {
      out << "7";
      for (const double r : reals) out << ' ' << r;
      out << ' ' << s.label[i] << ' ' << s.id[i] << '\n';
      continue;
    }
    const bool big = order == Order::big;
    out << bytes_of(std::uint8_t{7});
    for (const double r : reals) out << (wide ? bytes_of(r, big) : bytes_of(static_cast<float>(r), big));
    out << bytes_of(static_cast<std::int16_t>(s.label[i]), big) << bytes_of(static_cast<std::int32_t>(s.id[i]), big);
  }
  return out.str();
}

struct PlyCase : ::testing::TestWithParam<std::tuple<Order, bool>> {};

TEST_P(PlyCase, every_encoding_and_precision_gives_the_same_surfels) {
  const auto [order, wide] = GetParam();
  const Eigen::Vector3d shift = wide ? Eigen::Vector3d(500000, 4600000, 0) : Eigen::Vector3d::Zero();
  const LoadedScene loaded = load_scene(own_file("a.ply", ply_bytes(sample(shift), order, wide)));
  expect_same(sample(shift), loaded);
  EXPECT_EQ(loaded.scene.origin, shift + Eigen::Vector3d(1, 1, 0));  // middle of the box: 1.375 0.5 -0.09
}

INSTANTIATE_TEST_SUITE_P(Formats, PlyCase,
                         ::testing::Combine(::testing::Values(Order::ascii, Order::little, Order::big),
                                            ::testing::Bool()));

TEST(Ply, colours_in_any_order_and_obj_info_move_no_coordinate) {
  const LoadedScene loaded = load_scene(
      own_file("a.ply",
               "ply\nformat ascii 1.0\nobj_info num_cols 1\nobj_info num_rows 1\nelement vertex 3\nproperty uchar "
               "blue\nproperty float x\nproperty float y\nproperty uchar red\nproperty float z\nproperty float "
               "nx\nproperty float ny\nproperty float nz\nend_header\n"
               "9 1 2 8 3 0 0 1\n9 4 5 8 6 0 0 1\n9 7 8 8 10 0 0 1\n"));
  ASSERT_EQ(loaded.scene.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(world(loaded.scene, i), Eigen::Vector3d(1, 2, 3) + i * Eigen::Vector3d(3, 3, i < 2 ? 3 : 3.5)) << i;
  }
}

TEST(Ply, faces_with_indices_of_any_type_are_read) {
  for (const char* list : {"uchar uchar", "uchar short", "uchar ushort", "ushort int", "uint uint", "uchar float"}) {
    LoadOptions options;
    options.mesh_spacing = 0.1;
    const LoadedScene loaded = load_scene(
        own_file("a.ply", std::string("ply\nformat ascii 1.0\nelement face 1\nproperty list ") + list +
                              " vertex_index\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
                              "z\nend_header\n4 0 1 2 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"),
        options);
    EXPECT_EQ(loaded.report.triangles_read, 2u) << list;
    EXPECT_EQ(loaded.scene.size(), 100u) << list;
  }
}

pcl::PCLPointCloud2 pcl_cloud(const Sample& s, bool wide) {
  pcl::PCLPointCloud2 cloud;
  const std::uint8_t real = wide ? pcl::PCLPointField::FLOAT64 : pcl::PCLPointField::FLOAT32;
  std::vector<std::pair<std::string, std::uint8_t>> fields;
  for (const char* name : {"x", "y", "z", "normal_x", "normal_y", "normal_z", "area"}) fields.push_back({name, real});
  fields.push_back({"label", pcl::PCLPointField::UINT32});
  fields.push_back({"id", pcl::PCLPointField::UINT32});
  for (const auto& [name, type] : fields) {
    pcl::PCLPointField field;
    field.name = name;
    field.datatype = type;
    field.count = 1;
    field.offset = cloud.point_step;
    cloud.fields.push_back(field);
    cloud.point_step += type == pcl::PCLPointField::FLOAT64 ? 8 : 4;
  }
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(s.position.size());
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.is_dense = 1;
  std::string bytes;
  const auto add = [&](double r) { bytes += wide ? bytes_of(r) : bytes_of(static_cast<float>(r)); };
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    for (const double r : s.position[i]) add(r);
    for (const double r : s.normal[i]) add(r);
    add(s.area[i]);
    bytes += bytes_of(s.label[i]) + bytes_of(s.id[i]);
  }
  cloud.data.assign(bytes.begin(), bytes.end());
  return cloud;
}

struct PcdCase : ::testing::TestWithParam<std::tuple<std::string, bool>> {};

TEST_P(PcdCase, every_encoding_and_precision_written_by_pcl_gives_the_same_surfels) {
  const auto [encoding, wide] = GetParam();
  const Eigen::Vector3d shift = wide ? Eigen::Vector3d(500000, 4600000, 0) : Eigen::Vector3d::Zero();
  const std::string path = own_path("a.pcd");
  const pcl::PCLPointCloud2 cloud = pcl_cloud(sample(shift), wide);
  pcl::PCDWriter writer;
  const Eigen::Vector4f zero = Eigen::Vector4f::Zero();
  const Eigen::Quaternionf none = Eigen::Quaternionf::Identity();
  if (encoding == "ascii") writer.writeASCII(path, cloud, zero, none, 17);
  if (encoding == "binary") writer.writeBinary(path, cloud, zero, none);
  if (encoding == "binary_compressed") writer.writeBinaryCompressed(path, cloud, zero, none);
  const LoadedScene loaded = load_scene(path);
  expect_same(sample(shift), loaded);
  EXPECT_EQ(loaded.report.format, "PCD " + encoding);
}

INSTANTIATE_TEST_SUITE_P(Formats, PcdCase,
                         ::testing::Combine(::testing::Values("ascii", "binary", "binary_compressed"),
                                            ::testing::Bool()));

std::string text_of(const Sample& s, const std::string& header, const std::string& between, const char* end) {
  std::ostringstream out;
  out.precision(17);
  out << header;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    for (const double r : s.position[i]) out << r << between;
    for (const double r : s.normal[i]) out << r << between;
    out << s.area[i] << between << s.label[i] << between << s.id[i] << end;
  }
  return out.str();
}

TEST(TextCloud, blanks_tabs_commas_and_semicolons_separate_named_columns) {
  const Sample far = sample({500000, 4600000, 0});
  expect_same(far, load_scene(own_file("a.txt", text_of(far, "x y z nx ny nz area label id\n", " ", "\n"))));
  expect_same(far, load_scene(own_file("b.csv", text_of(far, "x,y,z,nx,ny,nz,area,material,id\n", ",", "\n"))));
  expect_same(far, load_scene(own_file("c.csv", text_of(far, "X;Y;Z;Nx;Ny;Nz;Area;Class;ID\n", ";", "\r\n"))));
  expect_same(far, load_scene(own_file("d.asc",
                                       text_of(far, "# made by hand\n// X Y Z Nx Ny Nz area label id\n", "\t", "\n"))));
  expect_same(far, load_scene(own_file(
                       "e.csv", text_of(far, "\"x\", \"y\", \"z\", nx, ny, nz, area, label, id\n", " , ", "\n"))));
}

TEST(TextCloud, without_names_three_columns_are_coordinates_and_unit_vectors_after_them_normals) {
  const LoadedScene with = load_scene(own_file("a.xyz", "2\n0 0 0 0 0 1\n1.5 0 +2 0 1 0\n"));
  ASSERT_EQ(with.scene.size(), 2u);
  EXPECT_EQ(world(with.scene, 1), Eigen::Vector3d(1.5, 0, 2));
  EXPECT_EQ(with.scene.normal[1], Eigen::Vector3f(0, 1, 0));
  const LoadedScene colours = load_scene(own_file("b.xyz", "0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 0 0 255\n"));
  EXPECT_TRUE(colours.report.normals_estimated);
  EXPECT_TRUE(has_note(colours.report, "columns after z were ignored"));
}

vtkNew<vtkPolyData> vtk_cloud(const Sample& s, bool wide) {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataType(wide ? VTK_DOUBLE : VTK_FLOAT);
  vtkNew<vtkFloatArray> normals, area;
  vtkNew<vtkDoubleArray> label, id;
  normals->SetNumberOfComponents(3);
  normals->SetName("Normals");
  area->SetName("area");
  label->SetName("label");
  id->SetName("id");
  vtkNew<vtkCellArray> vertices;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const vtkIdType at = points->InsertNextPoint(s.position[i].data());
    vertices->InsertNextCell(1, &at);
    normals->InsertNextTuple(s.normal[i].data());
    area->InsertNextValue(static_cast<float>(s.area[i]));
    label->InsertNextValue(s.label[i]);
    id->InsertNextValue(s.id[i]);
  }
  data->SetPoints(points);
  data->SetVerts(vertices);
  data->GetPointData()->SetNormals(normals);
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{area, label, id})
    data->GetPointData()->AddArray(array);
  return data;
}

struct VtkCase : ::testing::TestWithParam<std::tuple<std::string, bool, bool>> {};

TEST_P(VtkCase, polydata_written_by_vtk_gives_the_same_surfels) {
  const auto [extension, binary, wide] = GetParam();
  const Eigen::Vector3d shift = wide ? Eigen::Vector3d(500000, 4600000, 0) : Eigen::Vector3d::Zero();
  const std::string path = own_path("a" + extension);
  const vtkNew<vtkPolyData> data = vtk_cloud(sample(shift), wide);
  if (extension == ".vtk") {
    vtkNew<vtkPolyDataWriter> writer;
    writer->SetFileName(path.c_str());
    writer->SetInputData(data);
    // VTK writes ASCII doubles with 11 digits, enough for these 9.
    binary ? writer->SetFileTypeToBinary() : writer->SetFileTypeToASCII();
    writer->Write();
  } else {
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName(path.c_str());
    writer->SetInputData(data);
    binary ? writer->SetDataModeToAppended() : writer->SetDataModeToAscii();
    writer->Write();
  }
  const LoadedScene loaded = load_scene(path);
  if (binary || !wide || extension == ".vtp") {
    expect_same(sample(shift), loaded);
  } else {
    ASSERT_EQ(loaded.scene.size(), 12u);
    for (std::size_t i = 0; i < 12; ++i) EXPECT_LT((world(loaded.scene, i) - sample(shift).position[i]).norm(), 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, VtkCase,
                         ::testing::Combine(::testing::Values(".vtk", ".vtp"), ::testing::Bool(), ::testing::Bool()));

TEST(ObjPoints, vertices_without_faces_are_a_cloud_with_the_normals_of_the_same_number) {
  const Sample s = sample({500000, 4600000, 0});
  std::ostringstream text;
  text.precision(17);
  text << "# points\nmtllib none.mtl\n";
  for (const auto& p : s.position) text << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  for (const auto& n : s.normal) text << "vn " << n.x() << ' ' << n.y() << ' ' << n.z() << '\n';
  expect_same(s, load_scene(own_file("a.obj", text.str())), false);
}

}  // namespace
