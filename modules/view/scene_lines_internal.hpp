#pragma once
#include <array>
#include <vector>

#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include "view/canvas_internal.hpp"
#include "view/scene_head_internal.hpp"

namespace insonify {

/// Lines of one colour in a scene, so many pixels wide; none yet.
vtkSmartPointer<vtkActor> line_actor(const Colour& colour, double width);
void set_lines(vtkActor* actor, const std::vector<Polyline>& lines);

/// The body of a head, lit; none yet.
vtkSmartPointer<vtkActor> body_actor();
/// rings   corners of its stern and of its front; empty: no body
void set_body(vtkActor* actor, const std::array<Polyline, 2>& rings);

}  // namespace insonify
