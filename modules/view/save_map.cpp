// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>

#include "core/error.hpp"
#include "files/input_file.hpp"
#include "files/path_status.hpp"
#include "files/pending_file.hpp"
#include "files/read_apart.hpp"
#include "view/grey_file.hpp"
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

HorizontalMap read_map_image(const std::string& path) {
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

}  // namespace

void save_map_image(const std::string& path, const HorizontalMap& map) {
  require_map(map, "save_map_image");
  const Grid<float>& first = map.fields.front().values;
  const VtkMessages messages;
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(first.rows()) + 1, static_cast<int>(first.cols()) + 1, 1);
  image->SetOrigin(map.x, map.y, 0);
  image->SetSpacing(map.cell, map.cell, map.cell);
  // Cells are ordered with columns varying fastest.
  UnitList units{"Points: m"};
  for (const SampleField& field : map.fields)
    add_array<vtkFloatArray>(image->GetCellData(), field.name, field.values.reshaped(), field.unit, units);
  list_units(image, units);
  image->GetCellData()->SetActiveScalars(map.fields.front().name.c_str());
  vtkNew<vtkXMLImageDataWriter> writer;
  write_xml(*writer, image, path, messages, "save_map_image");
}

void save_map_picture(const std::string& stem, const HorizontalMap& map, double window) {
  require_map(map, "save_map_picture");
  const Grid<float>& values = map.fields.front().values;
  const float highest = values.isFinite().select(values, -std::numeric_limits<float>::infinity()).maxCoeff();
  if (!std::isfinite(highest)) fail(ErrorKind::content, "save_map_picture: ", stem, ": no cell has a value");
  Grid<std::uint8_t> grey(values.cols(), values.rows());
  for (Eigen::Index row = 0; row < values.cols(); ++row)
    for (Eigen::Index column = 0; column < values.rows(); ++column) {
      const double below = (highest - values(column, row)) / window;
      grey(values.cols() - 1 - row, column) =
          std::isfinite(below) ? static_cast<std::uint8_t>(std::lround(255 - 254 * std::min(below, 1.0))) : 0;
    }
  save_grey_png(stem + ".png", grey);

  // The world file holds the size of a pixel and the middle of the upper left one.
  std::ostringstream world;
  world.precision(17);
  world << map.cell << "\n0\n0\n"
        << -map.cell << "\n"
        << map.x + map.cell / 2 << "\n"
        << map.y + (static_cast<double>(values.cols()) - 0.5) * map.cell << "\n";
  write_file(stem + ".pgw", world.str());
}

template <typename Stream>
void pass(Stream& stream, SampleField& field) {
  stream(field.name, field.values);
}

HorizontalMap load_map_image(const std::string& path) {
  require_regular_file(path);
  const auto read = [](ArraySender& to, const std::string& name) {
    const HorizontalMap map = read_map_image(name);
    to(map.x, map.y, map.cell, map.fields);
  };
  HorizontalMap map;
  read_apart(path, limits_of_file(size_of_file(path)), read, path)(map.x, map.y, map.cell, map.fields);
  return map;
}

}  // namespace insonify
