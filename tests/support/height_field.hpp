#pragma once
#include <functional>
#include <string>

#include "acoustics/water.hpp"
#include "beamforming/sonar_head.hpp"
#include "core/grid.hpp"

namespace insonify {

/// A surface z(x, y) on a square grid, level triangles between its nodes: a scene whose truth is known.
struct HeightField {
  Eigen::Vector2d corner = {0, 0};  ///< of node (0, 0) [m]
  double spacing = 0;               ///< [m]
  Grid<double> z;                   ///< node (row, column) stands at corner + spacing * (column, row)

  double at(const Eigen::Vector2d& p) const;  ///< -inf outside
};

/// Nodes at z(x, y) over [-half, half]^2 about `centre`.
HeightField height_field(const Eigen::Vector2d& centre, double half, double spacing,
                         const std::function<double(double, double)>& z);

/// Its nodes as text, x y z per line.
std::string points_of(const HeightField& field);

/// What the array hears of a Lambert surface, written from the definition and sharing nothing with the simulator but
/// the numbers of the head: expected energy [Pa^2 rms, summed over samples] of `groups` groups of neighbouring beams in
/// `bands` equal bands of the range gate. Every triangle is cut into `cuts`^2 facets; a facet counts if it faces the
/// head and no part of the field stands before it. Gaussian pulse and elevation pattern, one row of beams.
Grid<double> energy_by_definition(const HeightField& field, double lambert_mu, const SonarHead& head, const Pose& pose,
                                  const Medium& medium, int cuts, Eigen::Index groups, Eigen::Index bands);

/// The same sums of a simulated ping.
Grid<double> energy_of(const ComplexGridF& pressure, Eigen::Index groups, Eigen::Index bands);

}  // namespace insonify
