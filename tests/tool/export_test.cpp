// What `export` and --keep paths write for VTK's own readers.
#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStructuredGrid.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLStructuredGridReader.h>

#include "store/cube.hpp"
#include "tool/tool_runner.hpp"

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
  const Ping p = read_cube(path("out/cube.h5")).pings[0];
  const Grid<float> level = level_db(p);

  vtkNew<vtkXMLImageDataReader> image;
  image->SetFileName(path("vtk/image_000000.vti").c_str());
  image->Update();
  vtkDataArray* values = image->GetOutput()->GetCellData()->GetArray("level_db");
  ASSERT_NE(values, nullptr);
  ASSERT_EQ(values->GetNumberOfTuples(), level.size());
  for (Eigen::Index n = 0; n < level.cols(); n += 7)
    for (Eigen::Index b = 0; b < level.rows(); ++b)
      ASSERT_EQ(static_cast<float>(values->GetTuple1(n * level.rows() + b)), level(b, n));

  vtkNew<vtkXMLStructuredGridReader> grid;
  grid->SetFileName(path("vtk/fan_000000.vts").c_str());
  grid->Update();
  ASSERT_EQ(grid->GetOutput()->GetNumberOfCells(), level.size());
  double range[2];
  grid->GetOutput()->GetCellData()->GetArray("level_db")->GetRange(range);
  EXPECT_EQ(static_cast<float>(range[1]), level.maxCoeff());
  EXPECT_THAT(read("vtk/fan.pvd"), HasSubstr("file=\"fan_000000.vts\""));
}

TEST_F(Export, paths_start_and_end_at_the_head_and_bounce_where_asked) {
  succeed(ping + "-o out --keep paths --multipath --set surface.height_m=0");
  vtkNew<vtkXMLPolyDataReader> lines;
  lines->SetFileName(path("out/paths.vtp").c_str());
  lines->Update();
  vtkPolyData* data = lines->GetOutput();
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
  expect_refused("export harbour.ply -o vtk", 3, {"harbour.ply"});
  succeed(ping + "-o out");
  expect_refused("export out -o out", 4, {"out", "--force"});
}
