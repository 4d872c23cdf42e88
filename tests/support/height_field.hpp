// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "core/grid.hpp"
#include "sonar/sonar_head.hpp"
#include "sonar/water.hpp"

namespace insonify {

/// A surface z(x, y) on a square grid, a scene whose truth is known. Each cell has two level triangles, cut along the
/// diagonal that is shorter on the surface. A node that is NaN is a hole; a cell with one has the triangle of the other
/// three.
struct HeightField {
  using Triangle = std::array<Eigen::Vector3d, 3>;

  Eigen::Vector2d corner = {0, 0};  ///< position of node (0, 0) [m]
  double spacing = 0;               ///< [m]
  Grid<double> z;                   ///< node (row, column) stands at corner + spacing * (column, row)

  Eigen::Vector3d node(Eigen::Index row, Eigen::Index column) const;
  double at(const Eigen::Vector2d& p) const;  ///< -inf outside and in holes
  /// Returns the triangles of a cell, counter-clockwise seen from above.
  std::vector<Triangle> triangles(Eigen::Index row, Eigen::Index column) const;
  /// Returns true if no surface stands on the line from one of its points to another. Decided exactly, at each edge of
  /// a triangle that the line crosses: only there can the line pass from above a facet to below.
  bool in_view(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
};

/// Returns nodes at z(x, y) over [-half, half]^2 about `centre`.
HeightField height_field(const Eigen::Vector2d& centre, double half, double spacing,
                         const std::function<double(double, double)>& z);

/// Returns the nodes as text, x y z per line.
std::string points_of(const HeightField& field);

/// Returns the energy that the array receives from a Lambert surface, written from the definition and sharing nothing
/// with the simulator but the numbers of the head: expected energy [Pa^2 rms, summed over samples] of `groups` groups
/// of neighbouring beams in `bands` equal bands of the range gate. Every triangle is cut into `cuts`^2 facets; a facet
/// counts if it faces the head and no part of the field stands before it, or if `occlusion` is false. Gaussian pulse
/// and elevation pattern, one row of beams.
Grid<double> energy_by_definition(const HeightField& field, double lambert_mu, const SonarHead& head, const Pose& pose,
                                  const Medium& medium, int cuts, Eigen::Index groups, Eigen::Index bands,
                                  bool occlusion = true);

/// Returns the energy of a Lambert surface element before the array receives it [Pa^2 rms], in any fixed unit of its
/// area.
double heard_by_definition(const Eigen::Vector3d& in_head_axes, double cosine, double area, double lambert_mu,
                           const SonarHead& head, const Medium& medium);

/// Returns the sums of a simulated ping by the same groups and bands.
Grid<double> energy_of(const ComplexGridF& pressure, Eigen::Index groups, Eigen::Index bands);

}  // namespace insonify
