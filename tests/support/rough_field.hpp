// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "support/height_field.hpp"

namespace insonify {

/// Shape of rough_field.
struct RoughFieldOptions {
  Eigen::Vector2d centre = {0, 0};  ///< [m]
  double half = 3;                  ///< half a side [m]
  double spacing = 0.02;            ///< spacing of the nodes [m]
  double shortest = 0.12;           ///< shortest wave [m]
  double boulders = 0.5;            ///< number per square metre
  bool terraces = true;             ///< true: two steps of 0.2 m across the field
};

/// Returns a rough bed: waves from `shortest` to 2 m in all directions whose slopes are alike at every length (a power
/// law), boulders half sunk into it, and terraces; slopes to 70 degrees. Fixed to the world, so that fields of
/// different spacing are samples of one bed.
HeightField rough_field(const RoughFieldOptions& options = {});

/// Returns the field without its nodes in round holes, `across` wide [m], so many per square metre.
HeightField with_holes(HeightField field, double across, double per_square_metre);

/// Parameters of a cloud drawn from a field.
struct DrawOptions {
  double spacing = 0.02;  ///< [m]
  double stretch = 1;     ///< spacing along y over that along x, at the same number of points
  double jitter = 0;      ///< off the grid, in spacings to either side
  double noise = 0;       ///< standard deviation across the surface, in spacings
};

/// Returns points on the true surface of a field.
std::vector<Eigen::Vector3d> draw_points(const HeightField& field, const DrawOptions& options = {});

/// Returns points as text, x y z per line.
std::string text_of(const std::vector<Eigen::Vector3d>& points);

}  // namespace insonify
