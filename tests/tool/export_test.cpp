// SPDX-License-Identifier: BSD-3-Clause
// Reads with VTK's own readers what `export` and --keep paths write.
#include <nlohmann/json.hpp>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLStructuredGridReader.h>

#include "returns/sounding_columns.hpp"
#include "scene_io/load_scene.hpp"
#include "store/cube.hpp"
#include "support/vtk_file.hpp"
#include "tool/tool_runner.hpp"
#include "view/grey_file.hpp"

using namespace insonify;

class Export : public ToolTest {
 protected:
  const std::string ping =
      "ping harbour.ply --sonar p900-45 --set sonar.beams=16 --pose=0,0,-3,0,10,0 --range 2:15 --no-picture -q ";

  void SetUp() override { have("harbour.ply", "make-scene harbour --points 10000"); }
};

TEST_F(Export, gives_grids_and_images_that_hold_the_levels_of_the_cube) {
  succeed(ping + "-o out");
  succeed("export out -o vtk -q");
  const Ping p = ping_of("out");
  const Grid<float> level = level_db(p);

  const auto image = read_vtk<vtkXMLImageDataReader>(path("vtk/image_000000.vti"));
  vtkDataArray* values = image->GetCellData()->GetArray("level_db");
  ASSERT_NE(values, nullptr);
  ASSERT_EQ(values->GetNumberOfTuples(), level.size());
  for (Eigen::Index n = 0; n < level.cols(); n += 7)
    for (Eigen::Index b = 0; b < level.rows(); ++b)
      ASSERT_EQ(static_cast<float>(values->GetTuple1(n * level.rows() + b)), level(b, n));

  const auto grid = read_vtk<vtkXMLStructuredGridReader>(path("vtk/fan_000000.vts"));
  ASSERT_EQ(grid->GetNumberOfCells(), level.size());
  double range[2];
  grid->GetCellData()->GetArray("level_db")->GetRange(range);
  EXPECT_EQ(static_cast<float>(range[1]), level.maxCoeff());
  EXPECT_THAT(read("vtk/fan.pvd"), HasSubstr("file=\"fan_000000.vts\""));
  for (vtkDataSet* data : {static_cast<vtkDataSet*>(image), static_cast<vtkDataSet*>(grid)}) {
    auto* units = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("units"));
    ASSERT_NE(units, nullptr);
    std::string all;
    for (vtkIdType i = 0; i < units->GetNumberOfValues(); ++i) all += units->GetValue(i) + "\n";
    for (const char* unit : {"level_db: dB re 1 uPa\n", "range_compensated_level_db: dB re 1 uPa at 1 m\n",
                             "pressure_re: Pa, amplitude\n", "pressure_im: Pa, amplitude\n"})
      EXPECT_THAT(all, HasSubstr(unit));
    EXPECT_STREQ(data->GetCellData()->GetArray("level_db")->GetInformation()->Get(vtkDataArray::UNITS_LABEL()),
                 "dB re 1 uPa");
  }
  EXPECT_THAT(read("vtk/fan_000000.vts").substr(0, 400), HasSubstr("compressor=\"vtkZLibDataCompressor\""));
}

// Checks what ParaView shows of the returns: places in double, and every column under its name, with its unit.
TEST_F(Export, gives_returns_with_names_and_units) {
  succeed(ping + "-o out");
  succeed("export out -o vtk -q");
  const Soundings returns = load_soundings(path("out/returns.ply"));
  ASSERT_GT(returns.size(), 20U);
  const auto data = read_vtk<vtkXMLPolyDataReader>(path("vtk/returns.vtp"));
  ASSERT_EQ(data->GetNumberOfPoints(), static_cast<vtkIdType>(returns.size()));
  EXPECT_EQ(data->GetNumberOfVerts(), data->GetNumberOfPoints());
  EXPECT_EQ(data->GetPoints()->GetDataType(), VTK_DOUBLE);
  for (std::size_t i = 0; i < returns.size(); ++i) {
    Eigen::Vector3d p;
    data->GetPoint(static_cast<vtkIdType>(i), p.data());
    ASSERT_EQ(p, returns.position[i]);
  }
  auto* units = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("units"));
  ASSERT_NE(units, nullptr);
  std::string all;
  for (vtkIdType i = 0; i < units->GetNumberOfValues(); ++i) all += units->GetValue(i) + "\n";
  EXPECT_THAT(all, HasSubstr("level_db: dB re 1 uPa\nrange: m\nazimuth: rad"));
  std::size_t without = 0;  // numbers that stand for none
  const auto expect_column = [&](const char* name, const auto& values) {
    vtkDataArray* array = data->GetPointData()->GetArray(name);
    ASSERT_NE(array, nullptr) << name;
    EXPECT_TRUE(array->GetInformation()->Has(vtkDataArray::UNITS_LABEL())) << name;
    const bool real = std::is_same_v<decltype(values[0]), const float&>;
    EXPECT_EQ(array->GetDataType(), real ? VTK_FLOAT : VTK_INT) << name;
    for (std::size_t i = 0; i < values.size(); ++i) {
      double value = static_cast<double>(values[i]), read = array->GetTuple1(static_cast<vtkIdType>(i));
      if (value == Soundings::none) value = -1, ++without;
      ASSERT_TRUE(read == value || (std::isnan(read) && std::isnan(value))) << name << " " << i;
    }
  };
  each_column([&](const SoundingColumn& about, const auto& column) { expect_column(about.name, column); }, returns);
  EXPECT_GT(without, 0U) << "false alarms, of noise";
  EXPECT_THAT(all, HasSubstr("true_surfel: id in the scene; -1: none\n"));
}

// Exports the returns of the head that is named, of a survey of several heads, with the time and the head of each.
TEST_F(Export, gives_the_returns_of_one_head) {
  write("two.toml", R"(schema = 1
[survey]
scene = "harbour.ply"
[trajectory]
waypoints_m = [[0, 0, -3], [2, 0, -3]]
speed_m_s = 1
[[head]]
name = "left"
sonar = "p900-45"
range = "2:10"
set = ["sonar.beams=16"]
heading_deg = -20
pitch_deg = -20
rate_hz = 1
[[head]]
name = "right"
sonar = "p900-45"
range = "2:10"
set = ["sonar.beams=16"]
heading_deg = 20
pitch_deg = -20
rate_hz = 2
[ping]
noise = true
)");
  succeed("survey two.toml -q -o run");
  succeed("merge -q run");
  const SurveyReturns all = load_survey_returns({path("run/returns.ply")});
  ASSERT_GT(all.soundings.size(), 50U);
  for (const unsigned head : {0U, 1U}) {
    const std::string name = head == 0 ? "left" : "right";
    succeed("export run --head " + name + " -q -o " + name);
    const auto data = read_vtk<vtkXMLPolyDataReader>(path(name + "/returns.vtp"));
    std::vector<std::size_t> due;
    for (std::size_t i = 0; i < all.head.size(); ++i)
      if (all.head[i] == head) due.push_back(i);
    ASSERT_FALSE(due.empty());
    ASSERT_EQ(data->GetNumberOfPoints(), static_cast<vtkIdType>(due.size()));
    for (const char* column : {"time", "head", "ping", "true_surfel"})
      ASSERT_NE(data->GetPointData()->GetArray(column), nullptr) << column;
    std::vector<double> times;
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
      EXPECT_EQ(data->GetPointData()->GetArray("head")->GetTuple1(i), head);
      times.push_back(data->GetPointData()->GetArray("time")->GetTuple1(i));
      EXPECT_EQ(times.back(), data->GetPointData()->GetArray("ping")->GetTuple1(i) / (1 + head));
    }
    std::vector<double> expected;
    for (const std::size_t i : due) expected.push_back(all.time[i]);
    std::sort(times.begin(), times.end()), std::sort(expected.begin(), expected.end());
    EXPECT_EQ(times, expected);
  }
}

TEST_F(Export, paths_start_and_end_at_the_head_and_bounce_where_asked) {
  succeed(ping + "-o out --keep paths --multipath --set surface.height_m=0");
  const auto data = read_vtk<vtkXMLPolyDataReader>(path("out/paths.vtp"));
  ASSERT_GT(data->GetNumberOfLines(), 10);
  double bounces[2];
  data->GetCellData()->GetArray("bounces")->GetRange(bounces);
  EXPECT_EQ(bounces[0], 0);
  EXPECT_GE(bounces[1], 1);
  for (vtkIdType line = 0; line < data->GetNumberOfLines(); ++line) {
    vtkPoints* points = data->GetCell(line)->GetPoints();
    const vtkIdType last = points->GetNumberOfPoints() - 1;
    EXPECT_EQ(static_cast<double>(last), 2 + data->GetCellData()->GetArray("bounces")->GetTuple1(line));
    for (const vtkIdType end : {vtkIdType{0}, last}) {
      double p[3];
      points->GetPoint(end, p);
      EXPECT_EQ(p[0], 0);
      EXPECT_EQ(p[2], -3);
    }
  }
}

TEST_F(Export, bad_input_gets_one_line_and_leaves_nothing) {
  expect_refused("export nothing -o vtk", 4, {"nothing"});
  expect_refused("export out -o out.gsf", 2, {"--to = vtk makes a folder", "--to gsf"});
  expect_refused("export harbour.ply -o vtk", 3, {"harbour.ply"});
  succeed(ping + "-o out");
  expect_refused("export out -o out", 4, {"out", "is the input"});
}

// Pings of cold and of warm water: what is compensated is the absorption of each.
TEST_F(Export, gains_are_of_the_absorption_of_each_ping) {
  const std::string in = ping + "--set sonar.bin_size_m=0.01 --set water.temperature_c=";
  succeed(in + "2 -o cold");
  succeed(in + "25 --time 1 -o warm");
  succeed("merge -q cold warm -o both");
  succeed("export both -o vtk -q");
  succeed("export both --to png -o grey -q");
  const Cube cube = cube_of("both");
  ASSERT_EQ(cube.pings.size(), 2U);
  EXPECT_GT(std::abs(cube.pings[0].absorption_db_per_m - cube.pings[1].absorption_db_per_m), 0.05);
  const auto manifest = manifest_of("grey");
  const double black = manifest["black_db"], white = manifest["white_db"];
  for (std::size_t p = 0; p < 2; ++p) {
    const Ping& from = cube.pings[p];
    const std::string number = "00000" + std::to_string(p);
    const auto image = read_vtk<vtkXMLImageDataReader>(path("vtk/image_" + number + ".vti"));
    vtkDataArray* levels = image->GetCellData()->GetArray("range_compensated_level_db");
    ASSERT_NE(levels, nullptr);
    const GreyPicture grey = load_grey_png(path("grey/samples_" + number + ".png"));
    ASSERT_EQ(grey.value.rows(), from.pressure.cols());
    ASSERT_EQ(grey.value.cols(), from.pressure.rows());
    int within = 0;
    for (Eigen::Index n = 0; n < from.pressure.cols(); n += 5)
      for (Eigen::Index b = 0; b < from.pressure.rows(); ++b) {
        const double amplitude = std::abs(std::complex<double>(from.pressure(b, n)));
        if (!(amplitude > 1e-3)) continue;
        const double r = from.gate.centre(static_cast<std::size_t>(n));
        const double expected =
            20 * std::log10(amplitude / std::sqrt(2.0) / 1e-6) + 40 * std::log10(r) + 2 * from.absorption_db_per_m * r;
        EXPECT_NEAR(levels->GetTuple1(n * from.pressure.rows() + b), expected, 1e-4);
        if (!(expected > black && expected < white)) continue;
        ++within;
        const int value = grey.value(from.pressure.cols() - 1 - n, from.pressure.rows() - 1 - b);
        EXPECT_NEAR(black + value / 65535.0 * (white - black), expected, 1.02 * (white - black) / 65535);
      }
    EXPECT_GT(within, 100);
  }
}
