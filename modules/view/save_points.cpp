#include <algorithm>
#include <type_traits>

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include "core/error.hpp"
#include "returns/sounding_columns.hpp"
#include "view/save_vtk.hpp"
#include "view/xml_file_internal.hpp"

namespace insonify {

namespace {

/// Adds a column to the point data, and its unit to the list of units.
template <typename Array, typename Column>
void add_column(vtkPolyData* data, vtkStringArray* units, const std::string& name, const std::string& unit,
                const Column& column) {
  const auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  array->SetNumberOfValues(static_cast<vtkIdType>(column.size()));
  std::copy(column.begin(), column.end(), array->GetPointer(0));
  array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit.c_str());
  data->GetPointData()->AddArray(array);
  units->InsertNextValue(name + ": " + unit);
}

}  // namespace

void save_points(const std::string& path, const Soundings& soundings, const std::vector<PointColumn>& more) {
  const auto count = static_cast<vtkIdType>(soundings.size());
  const auto require_length = [&](const std::string& name, std::size_t length) {
    if (length != soundings.size())
      fail(ErrorKind::argument, "save_points: ", path, ": column '", name, "' has ", length,
           " entries, must have one for each of the ", soundings.size(), " soundings");
  };
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

  vtkNew<vtkStringArray> units;
  units->SetName("units");
  units->InsertNextValue("Points: m");
  each_column(
      [&](const SoundingColumn& about, const auto& column) {
        require_length(about.name, column.size());
        using Real = std::is_same<typename std::decay_t<decltype(column)>::value_type, float>;
        using Array = std::conditional_t<Real::value, vtkFloatArray, vtkIntArray>;
        add_column<Array>(data, units, about.name, signed_unit(about), column);
      },
      soundings);
  for (const PointColumn& column : more) {
    require_length(column.name, column.values.size());
    if (column.whole)
      add_column<vtkIntArray>(data, units, column.name, column.unit, column.values);
    else
      add_column<vtkDoubleArray>(data, units, column.name, column.unit, column.values);
  }
  data->GetPointData()->SetActiveScalars("level_db");
  data->GetFieldData()->AddArray(units);
  vtkNew<vtkXMLPolyDataWriter> writer;
  write_xml(*writer, data, path, "save_points");
}

}  // namespace insonify
