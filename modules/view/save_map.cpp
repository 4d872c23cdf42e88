// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <sstream>

#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataWriter.h>

#include "core/error.hpp"
#include "files/pending_file.hpp"
#include "view/grey_file.hpp"
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

}  // namespace insonify
