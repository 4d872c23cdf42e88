#include <algorithm>
#include <type_traits>

#include <vtkCellArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedIntArray.h>
#include <vtkXMLPolyDataWriter.h>

#include "core/error.hpp"
#include "returns/sounding_columns.hpp"
#include "view/save_vtk.hpp"
#include "view/xml_file_internal.hpp"

namespace insonify {

void save_points(const std::string& path, const Soundings& soundings) {
  const auto count = static_cast<vtkIdType>(soundings.size());
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
        if (column.size() != soundings.size())
          fail(ErrorKind::argument, "save_points: ", path, ": column '", about.name, "' has ", column.size(),
               " entries, must have one for each of the ", soundings.size(), " soundings");
        using Real = std::is_same<typename std::decay_t<decltype(column)>::value_type, float>;
        using Array = std::conditional_t<Real::value, vtkFloatArray, vtkUnsignedIntArray>;
        const auto array = vtkSmartPointer<Array>::New();
        array->SetName(about.name);
        array->SetNumberOfValues(count);
        std::copy(column.begin(), column.end(), array->GetPointer(0));
        array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), about.unit);
        data->GetPointData()->AddArray(array);
        units->InsertNextValue(std::string(about.name) + ": " + about.unit);
      },
      soundings);
  data->GetPointData()->SetActiveScalars("level_db");
  data->GetFieldData()->AddArray(units);
  vtkNew<vtkXMLPolyDataWriter> writer;
  write_xml(*writer, data, path, "save_points");
}

}  // namespace insonify
