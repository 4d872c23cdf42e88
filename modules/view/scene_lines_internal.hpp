#pragma once
#include <array>
#include <vector>

#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include "view/canvas_internal.hpp"
#include "view/scene_head_internal.hpp"

namespace insonify {

/// An actor, initially empty, for lines of one colour and width [pixels].
vtkSmartPointer<vtkActor> line_actor(const Colour& colour, double width);
void set_lines(vtkActor* actor, const std::vector<Polyline>& lines);

/// An actor, initially empty, for the shaded body of a head.
vtkSmartPointer<vtkActor> body_actor();
/// Sets the body; `rings` are the corners of its stern and front, empty for no body.
void set_body(vtkActor* actor, const std::array<Polyline, 2>& rings);

}  // namespace insonify
