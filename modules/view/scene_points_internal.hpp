// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <vtkActor.h>
#include <vtkDataArray.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include "view/colour_maps_internal.hpp"

namespace insonify {

/// Draws points as squares of a given size in metres, which appear larger as the camera approaches.
class SquareMapper : public vtkOpenGLPolyDataMapper {
 public:
  static SquareMapper* New();
  vtkTypeMacro(SquareMapper, vtkOpenGLPolyDataMapper);

  double growth = 1;                       ///< factor on the points' own side
  double min_pixels = 2, max_pixels = 64;  ///< limits of a side
  std::array<double, 6> bounds{};          ///< bounds of the points drawn; saves VTK a search in every frame
  double lift = 0;  ///< draws points nearer to the eye by this fraction of the distance; 1: in front of everything

  void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override;

 protected:
  void ComputeBounds() override;
  void ReplaceShaderPositionVC(std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer,
                               vtkActor* actor) override;
  void SetMapperShaderParameters(vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor) override;
};

/// Points with the arrays that VTK needs to draw them. Positions are not copied: they must stay valid and in place.
struct PointCloudArrays {
  vtkSmartPointer<vtkDataArray> position;         ///< 3 floats each
  vtkSmartPointer<vtkDataArray> side;             ///< [m]
  vtkSmartPointer<vtkUnsignedCharArray> colours;  ///< 4 bytes each
};
PointCloudArrays point_arrays(std::span<const Eigen::Vector3f> position, const std::vector<float>& side);

std::span<const float> sides_of(const PointCloudArrays& arrays);

/// Overwrites the colours, one per point, and marks them as changed.
void set_colours(vtkUnsignedCharArray* to, std::span<const Rgb> colour);

/// Returns an actor that draws the points listed in `drawn`. Actors may share arrays: the points are then stored, and
/// uploaded to GL, only once.
vtkSmartPointer<vtkActor> point_actor(const PointCloudArrays& arrays, std::span<const std::uint32_t> drawn);

/// Makes an actor of point_actor draw other points, of the same or other arrays.
void set_points(vtkActor* actor, const PointCloudArrays& arrays, std::span<const std::uint32_t> drawn);

/// Returns the mapper of an actor made by point_actor.
SquareMapper* mapper_of(vtkActor* actor);

}  // namespace insonify
