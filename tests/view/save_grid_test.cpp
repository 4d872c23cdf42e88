// SPDX-License-Identifier: BSD-3-Clause
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkStructuredGrid.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLStructuredGridReader.h>

#include "support/test.hpp"
#include "support/vtk_file.hpp"
#include "view/save_vtk.hpp"

namespace insonify {
namespace {

namespace fs = std::filesystem;

const RangeGate gate{1, 3, 0.25};

/// Returns a field with the value 100 b + n in beam b, bin n.
SampleField counted(const BeamFan& fan) {
  SampleField field{"level_db", Grid<float>(fan.beams(), gate.bins())};
  for (Eigen::Index b = 0; b < field.values.rows(); ++b)
    for (Eigen::Index n = 0; n < field.values.cols(); ++n) field.values(b, n) = static_cast<float>(100 * b + n);
  return field;
}

/// Returns the middle of a cell's corners.
Eigen::Vector3d middle_of(vtkDataSet* data, vtkIdType cell) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  vtkPoints* points = data->GetCell(cell)->GetPoints();
  for (vtkIdType p = 0; p < points->GetNumberOfPoints(); ++p) sum += Eigen::Map<Eigen::Vector3d>(points->GetPoint(p));
  return sum / static_cast<double>(points->GetNumberOfPoints());
}

TEST(SavedForVtk, every_cell_of_a_fan_stands_where_its_sample_does_in_the_world_and_holds_its_value) {
  const BeamFan fan = make_fan(9, radians(90), radians(10), radians(20), radians(-15));
  const Pose pose = pose_from_yaw_pitch_roll({500000.25, 4500000.5, -12}, radians(30), radians(20), radians(5));
  const SampleField field = counted(fan);
  save_fan_grid(own_path("fan.vts"), fan, gate, {field}, pose);

  const auto grid = read_vtk<vtkXMLStructuredGridReader>(own_path("fan.vts"));
  auto* values = vtkFloatArray::SafeDownCast(grid->GetCellData()->GetArray("level_db"));
  ASSERT_NE(values, nullptr);
  ASSERT_EQ(grid->GetNumberOfCells(), field.values.size());
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    const Eigen::Vector3d in_head = pose.inverse() * middle_of(grid, cell);
    const Direction direction = direction_of(in_head);
    const auto number = static_cast<int>(values->GetValue(cell));
    const int beam = number / 100, bin = number % 100;
    EXPECT_NEAR(direction.azimuth, fan.azimuth[beam], 1e-6) << "beam " << beam;
    EXPECT_NEAR(in_head.norm(), gate.centre(bin), 0.005 * gate.centre(bin));  // chord across 10 degrees
  }
}

/// Returns three beams at 10 degrees above and `beams` as far below.
BeamFan two_rows(std::size_t beams) {
  BeamFan fan = make_fan(3, radians(30), radians(10), radians(20), radians(10));
  const BeamFan low = make_fan(beams, radians(30), radians(10), radians(20), radians(-10));
  fan.azimuth.insert(fan.azimuth.end(), low.azimuth.begin(), low.azimuth.end());
  fan.elevation.insert(fan.elevation.end(), low.elevation.begin(), low.elevation.end());
  return fan;
}

TEST(SavedForVtk, rows_of_the_same_bearings_are_the_layers_of_a_volume) {
  const BeamFan fan = two_rows(3);
  const Pose pose = pose_from_yaw_pitch_roll({1, 2, 3}, radians(30), radians(10), radians(5));
  const auto files = save_fan_grid(own_path("fan.vts"), fan, gate, {counted(fan)}, pose);
  ASSERT_EQ(files, std::vector<std::string>{own_path("fan.vts")});
  const auto grid = read_vtk<vtkXMLStructuredGridReader>(files.front());
  auto* values = vtkFloatArray::SafeDownCast(grid->GetCellData()->GetArray("level_db"));
  ASSERT_NE(values, nullptr);
  ASSERT_EQ(grid->GetNumberOfCells(), static_cast<vtkIdType>(fan.beams() * gate.bins()));
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    const Direction direction = direction_of(pose.inverse() * middle_of(grid, cell));
    const auto number = static_cast<int>(values->GetValue(cell));
    EXPECT_NEAR(direction.azimuth, fan.azimuth[number / 100], 0.002) << "beam " << number / 100;
    EXPECT_NEAR(direction.elevation, fan.elevation[number / 100], 0.002) << "beam " << number / 100;
  }
}

TEST(SavedForVtk, rows_of_other_bearings_become_files_by_ascending_elevation) {
  const BeamFan fan = two_rows(4);
  const auto files = save_fan_grid(own_path("fan.vts"), fan, gate, {counted(fan)}, Pose::Identity());

  ASSERT_EQ(files.size(), 2u);
  for (int row = 0; row < 2; ++row) {
    EXPECT_EQ(files[static_cast<std::size_t>(row)], own_path("fan_row_00" + std::to_string(row) + ".vts"));
    const auto data = read_vtk<vtkXMLStructuredGridReader>(files[static_cast<std::size_t>(row)]);
    EXPECT_NEAR(direction_of(middle_of(data, 0)).elevation, radians(row == 0 ? -10 : 10), 0.002);
    double range[2];
    data->GetCellData()->GetArray("level_db")->GetRange(range);
    EXPECT_EQ(range[0], row == 0 ? 300 : 0);
  }
}

TEST(SavedForVtk, image_holds_the_samples_bit_for_bit_beam_across_and_range_upwards) {
  const BeamFan fan = make_fan(5, radians(60), radians(10), radians(20));
  SampleField field = counted(fan);
  field.values(2, 3) = 0.1f;
  save_sample_image(own_path("image.vti"), fan, gate, {field});

  const auto data = read_vtk<vtkXMLImageDataReader>(own_path("image.vti"));
  auto* values = vtkFloatArray::SafeDownCast(data->GetCellData()->GetArray("level_db"));
  ASSERT_NE(values, nullptr);
  for (Eigen::Index b = 0; b < field.values.rows(); ++b)
    for (Eigen::Index n = 0; n < field.values.cols(); ++n) {
      const vtkIdType cell = n * field.values.rows() + b;
      EXPECT_EQ(values->GetValue(cell), field.values(b, n));
      const Eigen::Vector3d middle = middle_of(data, cell);
      EXPECT_NEAR(middle.x(), static_cast<double>(b) + 0.5, 1e-9);
      EXPECT_NEAR(middle.y(), gate.centre(static_cast<std::size_t>(n)), 1e-9);
    }
}

TEST(SavedForVtk, series_names_its_files_beside_it_with_their_times) {
  save_series(own_path("fan.pvd"), {{0.5, 0, own_path("fan_000000.vts")}, {1.25, 1, own_path("fan_000001.vts")}});
  std::stringstream text;
  text << std::ifstream(own_path("fan.pvd")).rdbuf();
  EXPECT_THAT(text.str(), HasSubstr(R"(<DataSet timestep="0.5" part="0" file="fan_000000.vts"/>)"));
  EXPECT_THAT(text.str(), HasSubstr(R"(<DataSet timestep="1.25" part="1" file="fan_000001.vts"/>)"));
}

TEST(SavedForVtk, lines_come_back_with_their_points_and_numbers) {
  const LineSet lines{{{{1e6, 2, 3}, {4, 5, 6}}, {{0, 0, 0}, {1, 1, 1}, {2, 0, 0.1}}}, {{"level_db", {80, 90}}}};
  save_lines(own_path("paths.vtp"), lines);
  const auto data = read_vtk<vtkXMLPolyDataReader>(own_path("paths.vtp"));
  ASSERT_EQ(data->GetNumberOfLines(), 2);
  EXPECT_EQ(data->GetCell(1)->GetNumberOfPoints(), 3);
  EXPECT_EQ(Eigen::Vector3d(data->GetPoint(0)), Eigen::Vector3d(1e6, 2, 3));
  EXPECT_EQ(Eigen::Vector3d(data->GetPoint(4)), Eigen::Vector3d(2, 0, 0.1));
  EXPECT_EQ(data->GetCellData()->GetArray("level_db")->GetTuple1(1), 90);
}

TEST(SavedForVtk, same_samples_make_the_same_bytes) {
  const BeamFan fan = make_fan(5, radians(60), radians(10), radians(20));
  for (const char* name : {"a.vts", "b.vts"})
    save_fan_grid(own_path(name), fan, gate, {counted(fan)}, Pose::Identity());
  std::stringstream a, b;
  a << std::ifstream(own_path("a.vts")).rdbuf();
  b << std::ifstream(own_path("b.vts")).rdbuf();
  EXPECT_GT(a.str().size(), 500u);
  EXPECT_EQ(a.str(), b.str());
}

TEST(SavedForVtk, wrong_fields_lines_and_folders_are_refused_and_leave_nothing) {
  const BeamFan fan = make_fan(5, radians(60), radians(10), radians(20));
  SampleField narrow = counted(fan);
  narrow.values.conservativeResize(4, narrow.values.cols());
  EXPECT_THROW(save_fan_grid(own_path("x.vts"), fan, gate, {}, Pose::Identity()), Error);
  EXPECT_THROW(save_fan_grid(own_path("x.vts"), fan, gate, {narrow}, Pose::Identity()), Error);
  EXPECT_THROW(save_sample_image(own_path("x.vti"), fan, gate, {counted(fan), counted(fan)}), Error);
  EXPECT_THROW(save_lines(own_path("x.vtp"), {{{{0, 0, 0}}}, {}}), Error);
  EXPECT_THROW(save_lines(own_path("x.vtp"), {{{{0, 0, 0}, {1, 0, 0}}}, {{"level_db", {}}}}), Error);
  EXPECT_THROW(save_sample_image(own_path("nowhere/x.vti"), fan, gate, {counted(fan)}), Error);
  EXPECT_TRUE(std::filesystem::is_empty(own_folder()));
}

}  // namespace
}  // namespace insonify
