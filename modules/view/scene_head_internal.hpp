#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "view/show_scene.hpp"

namespace insonify {

/// Points of a line, relative to scene.origin [m].
using Polyline = std::vector<Eigen::Vector3d>;

/// The solid angle of a fan in head axes. The circle is cut at its widest gap, so that a fan across the stern stays in
/// one piece; azimuths may then lie outside [-pi, pi].
struct FanSector {
  double low_azimuth = 0, high_azimuth = 0;      ///< edges: half a beam spacing beyond the outermost beams [rad]
  double first_azimuth = 0, last_azimuth = 0;    ///< of the outermost beams: starboard, port
  double low_elevation = 0, high_elevation = 0;  ///< half an elevation width beyond the rows [rad]
  std::vector<double> rows;                      ///< elevations of the fan, ascending; at most five of them
  bool full_circle = false;
};
FanSector fan_sector(const BeamFan& fan);

/// The lines that represent a head.
struct HeadLines {
  std::vector<Polyline> outline;       ///< edges of the sector, and its arcs at the ends of the gate
  std::vector<Polyline> arcs;          ///< at round ranges, in the plane of the fan
  std::vector<Polyline> beams;         ///< first and last beam of each row, unless they are neighbours
  std::array<Polyline, 3> axes;        ///< x, y, z of the head
  std::array<Polyline, 2> body_rings;  ///< stern and front of a round body along x
};

/// The lines of a head whose body has `size` [m]; its axes are twice as long.
HeadLines head_lines(const SceneHead& head, const Eigen::Vector3d& scene_origin, double size);

/// The surfels, ascending, that the walls of the sector and the ends of the gate intersect: within 0.7 of their spacing
/// sqrt(area), and facing the head if normals are oriented.
std::vector<std::uint32_t> footprint_outline(const SceneCloud& scene, const SceneHead& head);

}  // namespace insonify
