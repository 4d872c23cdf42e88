// SPDX-License-Identifier: BSD-3-Clause
#include <type_traits>

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include "core/error.hpp"
#include "returns/sounding_columns.hpp"
#include "view/save_vtk.hpp"
#include "view/xml_file_internal.hpp"

namespace insonify {

void save_points(const std::string& path, const Soundings& soundings, const std::vector<PointColumn>& more) {
  const auto count = static_cast<vtkIdType>(soundings.size());
  const auto require_length = [&](const std::string& name, std::size_t length) {
    if (length != soundings.size())
      fail(ErrorKind::argument, "save_points: ", path, ": column '", name, "' has ", length,
           " entries, must have one for each of the ", soundings.size(), " soundings");
  };
  const VtkMessages messages;
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < count; ++i) {
    points->InsertNextPoint(soundings.position[static_cast<std::size_t>(i)].data());
    vertices->InsertNextCell(1, &i);
  }
  data->SetPoints(points);
  data->SetVerts(vertices);

  UnitList units{"Points: m"};
  vtkPointData* columns = data->GetPointData();
  each_column(
      [&](const SoundingColumn& about, const auto& column) {
        require_length(about.name, column.size());
        using Real = std::is_same<typename std::decay_t<decltype(column)>::value_type, float>;
        using Array = std::conditional_t<Real::value, vtkFloatArray, vtkIntArray>;
        add_array<Array>(columns, about.name, column, signed_unit(about), units);
      },
      soundings);
  for (const PointColumn& column : more) {
    require_length(column.name, column.values.size());
    if (column.whole)
      add_array<vtkIntArray>(columns, column.name, column.values, column.unit, units);
    else
      add_array<vtkDoubleArray>(columns, column.name, column.values, column.unit, units);
  }
  columns->SetActiveScalars("level_db");
  list_units(data, units);
  vtkNew<vtkXMLPolyDataWriter> writer;
  write_xml(*writer, data, path, messages, "save_points");
}

}  // namespace insonify
