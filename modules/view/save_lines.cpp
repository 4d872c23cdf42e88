#include "view/save_lines.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include "core/error.hpp"
#include "view/save_xml_internal.hpp"

namespace insonify {
namespace {

constexpr const char* who = "save_lines";

void require_valid(const LineSet& lines) {
  for (std::size_t i = 0; i < lines.points.size(); ++i)
    if (lines.points[i].size() < 2)
      fail(ErrorKind::argument, who, ": line ", i, " has ", lines.points[i].size(), " points, must have at least 2");
  for (const LineSet::Field& field : lines.fields)
    if (field.values.size() != lines.points.size())
      fail(ErrorKind::argument, who, ": field '", field.name, "' has ", field.values.size(),
           " values, must have one per line (", lines.points.size(), ")");
}

}  // namespace

void save_lines(const std::string& path, const LineSet& lines) {
  require_valid(lines);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (const auto& line : lines.points) {
    cells->InsertNextCell(static_cast<int>(line.size()));
    for (const Eigen::Vector3d& p : line) cells->InsertCellPoint(points->InsertNextPoint(p.data()));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  for (const LineSet::Field& field : lines.fields) {
    vtkNew<vtkFloatArray> array;
    array->SetName(field.name.c_str());
    array->SetNumberOfValues(static_cast<vtkIdType>(field.values.size()));
    std::copy(field.values.begin(), field.values.end(), array->GetPointer(0));
    data->GetCellData()->AddArray(array);
  }
  if (!lines.fields.empty()) data->GetCellData()->SetActiveScalars(lines.fields.front().name.c_str());
  vtkNew<vtkXMLPolyDataWriter> writer;
  write_xml(*writer, data, path, who);
}

}  // namespace insonify
