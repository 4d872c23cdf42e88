#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>

#include "core/error.hpp"
#include "core/input_file.hpp"
#include "core/pending_file.hpp"
#include "view/off_screen_internal.hpp"
#include "view/save_vtk.hpp"
#include "view/xml_file_internal.hpp"

namespace insonify {
namespace {

void require_map(const HorizontalMap& map, const char* who) {
  if (map.fields.empty()) fail(ErrorKind::argument, who, ": no field to write");
  const Grid<float>& first = map.fields.front().values;
  for (const SampleField& field : map.fields)
    if (field.values.size() == 0 || field.values.rows() != first.rows() || field.values.cols() != first.cols())
      fail(ErrorKind::argument, who, ": ", field.name, " is ", field.values.rows(), " x ", field.values.cols(),
           ", must have cells, as many as ", map.fields.front().name);
}

}  // namespace

void save_map_image(const std::string& path, const HorizontalMap& map) {
  require_map(map, "save_map_image");
  const Grid<float>& first = map.fields.front().values;
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(first.rows()) + 1, static_cast<int>(first.cols()) + 1, 1);
  image->SetOrigin(map.x, map.y, 0);
  image->SetSpacing(map.cell, map.cell, map.cell);
  // Cells are ordered with columns varying fastest.
  for (const SampleField& field : map.fields) {
    const Grid<float> values = field.values.transpose();
    image->GetCellData()->AddArray(
        cell_array(field.name, values.data(), static_cast<std::size_t>(values.size()), field.unit));
  }
  list_units(image, "Points: m", map.fields);
  image->GetCellData()->SetActiveScalars(map.fields.front().name.c_str());
  vtkNew<vtkXMLImageDataWriter> writer;
  write_xml(*writer, image, path, "save_map_image");
}

HorizontalMap load_map_image(const std::string& path) {
  require_regular_file(path);
  const VtkMessages messages;
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  const std::array<int, 3> points = {image->GetDimensions()[0], image->GetDimensions()[1], image->GetDimensions()[2]};
  vtkCellData* cells = image->GetCellData();
  if (points[0] < 2 || points[1] < 2 || points[2] != 1 || cells->GetNumberOfArrays() == 0)
    fail(ErrorKind::content, path, ": is not a map that insonify wrote");
  HorizontalMap map{image->GetOrigin()[0], image->GetOrigin()[1], image->GetSpacing()[0], {}};
  for (int a = 0; a < cells->GetNumberOfArrays(); ++a) {
    vtkDataArray* array = cells->GetArray(a);
    SampleField field{array->GetName(), Grid<float>(points[0] - 1, points[1] - 1)};
    for (Eigen::Index row = 0; row < field.values.cols(); ++row)
      for (Eigen::Index column = 0; column < field.values.rows(); ++column)
        field.values(column, row) = static_cast<float>(array->GetComponent(row * field.values.rows() + column, 0));
    map.fields.push_back(std::move(field));
  }
  return map;
}

void save_map_picture(const std::string& stem, const HorizontalMap& map, double window) {
  require_map(map, "save_map_picture");
  const Grid<float>& values = map.fields.front().values;
  const float highest = values.isFinite().select(values, -std::numeric_limits<float>::infinity()).maxCoeff();
  if (!std::isfinite(highest)) fail(ErrorKind::content, "save_map_picture: ", stem, ": no cell has a value");
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(values.rows()), static_cast<int>(values.cols()), 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer());
  for (Eigen::Index row = 0; row < values.cols(); ++row)
    for (Eigen::Index column = 0; column < values.rows(); ++column) {
      const double below = (highest - values(column, row)) / window;
      *pixel++ = std::isfinite(below) ? static_cast<unsigned char>(std::lround(255 - 254 * std::min(below, 1.0))) : 0;
    }
  const VtkMessages messages;
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  write_png(writer, stem + ".png", messages, "save_map_picture");

  // The world file holds the size of a pixel and the middle of the upper left one.
  std::ostringstream world;
  world.precision(17);
  world << map.cell << "\n0\n0\n"
        << -map.cell << "\n"
        << map.x + map.cell / 2 << "\n"
        << map.y + (static_cast<double>(values.cols()) - 0.5) * map.cell << "\n";
  write_file(stem + ".pgw", world.str());
}

}  // namespace insonify
