// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// An elastic solid: density [kg/m^3] and speeds of its pressure and shear waves [m/s].
struct ElasticSolid {
  double density = 0, pressure_speed = 0;
  double shear_speed = 0;  ///< 0: a fluid
};

/// A smooth plane that mirrors sound: a wall, a quay, a plate. World frame [m].
struct Mirror {
  std::string name = "mirror";
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< a point of the plane
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< towards the water, of any length
  /// Corners of a convex plane with edges, counterclockwise as seen from the water; place and normal then follow from
  /// them (with_corners). Empty: the plane has no edges.
  std::vector<Eigen::Vector3d> corners{};
  double reflection = 1;                ///< reflection coefficient of pressure, within -1 (air) and 1 (rigid)
  std::optional<ElasticSolid> solid{};  ///< solid that reflects by E148 in place of `reflection`
  double rms_height = 0;                ///< rms height of its roughness [m]
  double thickness = 0.05;              ///< captured surfels along it that are nearer than this [m], and three times
                                        ///< its roughness, are the mirror itself
};

/// Returns a mirror with these corners, and with place and normal that follow from them.
Mirror with_corners(Mirror mirror, std::vector<Eigen::Vector3d> corners);
/// Returns a mirror with the corners of a rectangle about `position`: `width` [m] along the level direction in the plane
/// (along x if the plane is level), `height` [m] across it.
Mirror with_size(Mirror mirror, double width, double height);

/// A box of water with walls, a floor and a free surface on top, which reflects with -1.
struct Tank {
  Eigen::Vector3d size = Eigen::Vector3d::Zero();    ///< along x, y and z [m]
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();  ///< corner of least x, y and z, world [m]
  double reflection = 1;                             ///< reflection of walls and floor, as Mirror::reflection
  double rms_height = 0;                             ///< rms height of the roughness of walls and floor [m]
};

/// Returns the six planes of a tank, floor first, surface last.
std::vector<Mirror> mirrors_of(const Tank& tank);

/// Throws Error(argument) naming an invalid value of a mirror, its unit and its rule.
void require_valid(const Mirror& mirror, const char* who);
/// Throws Error(argument) naming an invalid value of a tank, its unit and its rule.
void require_valid(const Tank& tank, const char* who);

}  // namespace insonify
