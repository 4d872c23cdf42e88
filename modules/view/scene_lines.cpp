#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include "view/scene_lines_internal.hpp"

namespace insonify {
namespace {

// Adds a line's points and returns the number of the first.
vtkIdType add_points(vtkPoints* points, const Polyline& line) {
  const vtkIdType first = points->GetNumberOfPoints();
  for (const Eigen::Vector3d& place : line) points->InsertNextPoint(place.data());
  return first;
}

void show(vtkActor* actor, vtkPolyData* shape) {
  static_cast<vtkPolyDataMapper*>(actor->GetMapper())->SetInputData(shape);
}

vtkSmartPointer<vtkActor> empty_actor() {
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkPolyData> nothing;
  mapper->SetInputData(nothing);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

}  // namespace

vtkSmartPointer<vtkPolyData> polylines(const std::vector<Polyline>& lines, int coordinates) {
  vtkNew<vtkPoints> points;
  points->SetDataType(coordinates);
  vtkNew<vtkCellArray> cells;
  for (const Polyline& line : lines) {
    const vtkIdType first = add_points(points, line);
    cells->InsertNextCell(static_cast<int>(line.size()));
    for (std::size_t i = 0; i < line.size(); ++i) cells->InsertCellPoint(first + static_cast<vtkIdType>(i));
  }
  auto shape = vtkSmartPointer<vtkPolyData>::New();
  shape->SetPoints(points);
  shape->SetLines(cells);
  return shape;
}

vtkSmartPointer<vtkActor> line_actor(const Colour& colour, double width) {
  vtkSmartPointer<vtkActor> actor = empty_actor();
  vtkProperty* property = actor->GetProperty();
  property->LightingOff();
  property->SetColor(colour[0], colour[1], colour[2]);
  property->SetLineWidth(static_cast<float>(width));
  return actor;
}

void set_lines(vtkActor* actor, const std::vector<Polyline>& lines) { show(actor, polylines(lines, VTK_FLOAT)); }

vtkSmartPointer<vtkActor> body_actor() {
  vtkSmartPointer<vtkActor> actor = empty_actor();
  actor->GetProperty()->SetColor(0.98, 0.62, 0.1);
  actor->GetProperty()->SetAmbient(0.25);
  actor->GetProperty()->SetDiffuse(0.8);
  actor->GetProperty()->SetInterpolationToFlat();
  return actor;
}

void set_body(vtkActor* actor, const std::array<Polyline, 2>& rings) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> faces;
  const auto corners = static_cast<vtkIdType>(rings[0].size());
  for (const Polyline& ring : rings) {
    const vtkIdType first = add_points(points, ring);
    faces->InsertNextCell(static_cast<int>(corners));
    for (vtkIdType i = 0; i < corners; ++i) faces->InsertCellPoint(first + i);
  }
  for (vtkIdType i = 0; i < corners; ++i) {
    const vtkIdType next = (i + 1) % corners;
    faces->InsertNextCell({i, next, corners + next, corners + i});
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  if (corners > 0) shape->SetPolys(faces);
  show(actor, shape);
}

}  // namespace insonify
