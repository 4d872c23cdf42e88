// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "view/canvas_internal.hpp"
#include "view/scene_camera_internal.hpp"
#include "view/show_scene.hpp"

namespace insonify {

/// Points of a line, relative to scene.origin [m].
using Polyline = std::vector<Eigen::Vector3d>;

/// The solid angle of a fan in head axes. The circle is cut at its widest gap, so that a fan across the stern stays in
/// one piece; azimuths may then lie outside [-pi, pi].
struct FanSector {
  double low_azimuth = 0, high_azimuth = 0;      ///< edges: half a beam spacing beyond the outermost beams [rad]
  double first_azimuth = 0, last_azimuth = 0;    ///< azimuths of the outermost beams: starboard, port
  double low_elevation = 0, high_elevation = 0;  ///< half an elevation width beyond the rows [rad]
  std::vector<double> rows;                      ///< elevations of the fan, ascending; at most five of them
  bool full_circle = false;
};
FanSector fan_sector(const BeamFan& fan);
/// Returns the sectors of a fan: that of each beam for the two sides of a side-scan, else one.
std::vector<FanSector> fan_sectors(const BeamFan& fan);

/// The lines that represent a head.
struct HeadLines {
  std::vector<Polyline> outline;       ///< edges of the sector, and its arcs at the ends of the gate
  std::vector<Polyline> arcs;          ///< at round ranges, in the plane of the fan
  std::vector<Polyline> beams;         ///< first and last beam of each row, unless they are neighbours
  std::array<Polyline, 3> axes;        ///< x, y, z of the head
  std::array<Polyline, 2> body_rings;  ///< stern and front of a round body along x
};

/// Returns the lines of a head whose body has `size` [m]; its axes are twice as long.
HeadLines head_lines(const SceneHead& head, const Eigen::Vector3d& scene_origin, double size);

/// Returns the surfels, ascending, that the walls of the sector or the ends of the gate intersect: those within 0.7 of
/// their spacing sqrt(area), and, if normals are oriented, facing the head.
std::vector<std::uint32_t> footprint_outline(const SceneCloud& scene, const SceneHead& head);

/// A number or name beside an axis, at `position`; `outward` is a unit vector away from the box.
struct AxisLabel {
  std::string text;
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), outward = Eigen::Vector3d::UnitX();
  bool is_name = false;  ///< true: name of the axis, placed beyond its numbers
};

/// Axes of a box: floor grid, ticks and labels along the edges facing the camera. Relative to scene.origin.
struct SceneAxes {
  std::vector<Polyline> edges, grid, ticks;
  std::vector<AxisLabel> labels;  ///< labels of one axis by ascending value, then its name
};

/// Returns the axes of a box as seen in `view`. Labels are world coordinates [m]. An axis along the line of sight gets
/// no labels.
SceneAxes lay_out_axes(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& scene_origin, const CameraView& view);

/// Places labels in the box `frame` of a picture that shows `view`: numbers beside their ticks, names beyond them, far
/// enough out to overlap nothing. Labels that do not fit inside the frame are omitted.
std::vector<PlacedText> place_labels(const std::vector<AxisLabel>& labels, const CameraView& view, const Box& frame,
                                     int font_size);

/// Returns lines with coordinates of VTK_FLOAT or VTK_DOUBLE.
vtkSmartPointer<vtkPolyData> polylines(const std::vector<Polyline>& lines, int coordinates);

/// Returns an actor, initially empty, for lines of one colour and width [pixels].
vtkSmartPointer<vtkActor> line_actor(const Colour& colour, double width);
void set_lines(vtkActor* actor, const std::vector<Polyline>& lines);

/// Returns an actor, initially empty, for the shaded body of a head.
vtkSmartPointer<vtkActor> body_actor();
/// Sets the body; `rings` are the corners of its stern and front, empty for no body.
void set_body(vtkActor* actor, const std::array<Polyline, 2>& rings);

}  // namespace insonify
