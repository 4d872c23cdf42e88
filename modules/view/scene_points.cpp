// SPDX-License-Identifier: BSD-3-Clause
// vtk_glew.h must precede every other GL header.
// clang-format off
#include <vtk_glew.h>
#include "view/scene_points_internal.hpp"
// clang-format on

#include <algorithm>

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkMatrix4x4.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLCamera.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShader.h>
#include <vtkShaderProgram.h>
#include <vtkTypeInt32Array.h>

#include "core/parallel.hpp"

namespace insonify {
namespace {

constexpr const char* side_name = "surfel_side";
constexpr std::size_t points_at_once = 1 << 16;

// Returns the bounds in VTK's order: min and max of x, y, z; inverted if there are no points.
std::array<double, 6> bounds_of(vtkDataArray* position, std::span<const std::uint32_t> drawn) {
  const float* coordinates = static_cast<vtkFloatArray*>(position)->GetPointer(0);
  std::array<float, 6> box = {1, -1, 1, -1, 1, -1};
  for (std::size_t i = 0; i < drawn.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = coordinates[3 * std::size_t{drawn[i]} + c];
      box[2 * c] = i == 0 ? value : std::min(box[2 * c], value);
      box[2 * c + 1] = i == 0 ? value : std::max(box[2 * c + 1], value);
    }
  std::array<double, 6> bounds{};
  std::copy(box.begin(), box.end(), bounds.begin());
  return bounds;
}

}  // namespace

vtkStandardNewMacro(SquareMapper);

void SquareMapper::ComputeBounds() { std::copy(bounds.begin(), bounds.end(), Bounds); }

// Sizes each point in the vertex shader; VTK supports only one size in pixels for all.
void SquareMapper::ReplaceShaderPositionVC(std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer,
                                           vtkActor* actor) {
  std::string source = shaders[vtkShader::Vertex]->GetSource();
  vtkShaderProgram::Substitute(source, "//VTK::PositionVC::Dec",
                               "//VTK::PositionVC::Dec\n"
                               "in float surfel_side;\n"
                               "uniform float pixels_per_metre;\n"  // of a point at distance 1
                               "uniform float min_pixels;\n"
                               "uniform float max_pixels;\n"
                               "uniform float lift;\n"
                               "uniform float in_front;\n");
  vtkShaderProgram::Substitute(source, "//VTK::PositionVC::Impl",
                               "//VTK::PositionVC::Impl\n"
                               "gl_PointSize = clamp(surfel_side * pixels_per_metre / gl_Position.w,\n"
                               "                     min_pixels, max_pixels);\n"
                               "gl_Position.z = mix(gl_Position.z + lift, -gl_Position.w, in_front);\n");
  shaders[vtkShader::Vertex]->SetSource(source);
  Superclass::ReplaceShaderPositionVC(shaders, renderer, actor);
}

void SquareMapper::SetMapperShaderParameters(vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor) {
  Superclass::SetMapperShaderParameters(helper, renderer, actor);
  vtkMatrix4x4 *view_from_world, *clip_from_world, *clip_from_view;
  vtkMatrix3x3* normals;
  static_cast<vtkOpenGLCamera*>(renderer->GetActiveCamera())
      ->GetKeyMatrices(renderer, view_from_world, normals, clip_from_view, clip_from_world);
  // VTK keeps these matrices transposed, as GL wants them.
  const double focal_length = clip_from_view->GetElement(1, 1), depth_offset = clip_from_view->GetElement(3, 2);
  const double pixels = 0.5 * focal_length * renderer->GetSize()[1];
  const auto set = [&](const char* name, double value) {
    if (helper.Program->IsUniformUsed(name)) helper.Program->SetUniformf(name, static_cast<float>(value));
  };
  set("pixels_per_metre", growth * pixels);
  set("min_pixels", min_pixels);
  set("max_pixels", max_pixels);
  // Depth in clip space is a w + depth_offset; move it nearer by the fraction `lift` of the distance, at the same
  // pixel.
  set("lift", lift < 1 ? depth_offset * lift / (1 - lift) : 0);
  set("in_front", lift < 1 ? 0 : 0.999);
}

void SquareMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) {
  glEnable(GL_PROGRAM_POINT_SIZE);
  Superclass::RenderPieceDraw(renderer, actor);
  glDisable(GL_PROGRAM_POINT_SIZE);
}

PointCloudArrays point_arrays(std::span<const Eigen::Vector3f> position, const std::vector<float>& side) {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  const auto count = static_cast<vtkIdType>(position.size());
  vtkNew<vtkFloatArray> positions;
  positions->SetNumberOfComponents(3);
  positions->SetArray(const_cast<float*>(position.empty() ? nullptr : position.front().data()), 3 * count, 1);

  vtkNew<vtkFloatArray> sides;
  sides->SetName(side_name);
  sides->SetNumberOfTuples(count);
  std::copy(side.begin(), side.end(), sides->GetPointer(0));

  PointCloudArrays arrays{positions, sides, vtkSmartPointer<vtkUnsignedCharArray>::New()};
  arrays.colours->SetNumberOfComponents(4);  // VTK uses four components directly but copies three
  arrays.colours->SetNumberOfTuples(count);
  return arrays;
}

std::span<const float> sides_of(const PointCloudArrays& arrays) {
  auto* const side = static_cast<vtkFloatArray*>(arrays.side.Get());
  return {side->GetPointer(0), static_cast<std::size_t>(side->GetNumberOfTuples())};
}

void set_colours(vtkUnsignedCharArray* to, std::span<const Rgb> colour) {
  parallel_blocks(colour.size(), points_at_once, 0, [&](std::size_t begin, std::size_t end) {
    unsigned char* byte = to->GetPointer(static_cast<vtkIdType>(4 * begin));
    for (std::size_t i = begin; i < end; ++i) {
      byte = std::copy(colour[i].begin(), colour[i].end(), byte);
      *byte++ = 255;
    }
  });
  to->Modified();
}

void set_points(vtkActor* actor, const PointCloudArrays& arrays, std::span<const std::uint32_t> drawn) {
  // Store all points as one cell: 4 bytes per point instead of 16.
  vtkNew<vtkTypeInt32Array> ends, members;
  ends->SetNumberOfTuples(2);
  ends->SetValue(0, 0);
  ends->SetValue(1, static_cast<int>(drawn.size()));
  members->SetNumberOfTuples(static_cast<vtkIdType>(drawn.size()));
  std::copy(drawn.begin(), drawn.end(), members->GetPointer(0));
  vtkNew<vtkCellArray> cell;
  cell->SetData(ends, members);

  vtkNew<vtkPoints> points;
  points->SetData(arrays.position);
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  if (!drawn.empty()) shape->SetVerts(cell);
  shape->GetPointData()->SetScalars(arrays.colours);
  shape->GetPointData()->AddArray(arrays.side);

  SquareMapper* mapper = mapper_of(actor);
  mapper->bounds = bounds_of(arrays.position, drawn);
  mapper->SetInputData(shape);
}

vtkSmartPointer<vtkActor> point_actor(const PointCloudArrays& arrays, std::span<const std::uint32_t> drawn) {
  vtkNew<SquareMapper> mapper;
  mapper->SetColorModeToDirectScalars();
  mapper->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
  mapper->MapDataArrayToVertexAttribute(side_name, side_name, vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  set_points(actor, arrays, drawn);
  return actor;
}

SquareMapper* mapper_of(vtkActor* actor) { return static_cast<SquareMapper*>(actor->GetMapper()); }

}  // namespace insonify
