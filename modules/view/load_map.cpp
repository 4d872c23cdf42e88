// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <filesystem>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataReader.h>

#include "core/error.hpp"
#include "files/input_file.hpp"
#include "files/path_status.hpp"
#include "files/read_apart.hpp"
#include "view/off_screen_internal.hpp"
#include "view/save_vtk.hpp"

namespace insonify {
namespace {

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
