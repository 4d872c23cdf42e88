// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include <Eigen/Core>

#include "core/grid.hpp"

namespace insonify {

/// A line of equal values through the middles of cells; positions count cells, (0, 0) in the middle of the first.
using Contour = std::vector<Eigen::Vector2d>;

/// Returns the lines on which values, linear between the middles of neighbouring cells, have this level. Squares of
/// four cells with a NaN have none. A line that closes has its first position at its end again.
std::vector<Contour> contours_at(const Grid<float>& values, double level);

/// Returns how bright a slope is (E218): the cosine between its normal, stretched by `exaggeration`, and a light from
/// the upper left, 45 degrees high, divided by that of level ground; 1 at cells beside nothing.
///
/// values  heights in units of the side of a cell, as Grid of contours_at
Grid<float> relief_of(const Grid<float>& values, double exaggeration);

}  // namespace insonify
