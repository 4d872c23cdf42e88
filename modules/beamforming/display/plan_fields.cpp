// SPDX-License-Identifier: BSD-3-Clause
// How echoes pass from field to field of a cell, and from cell to cell (E183, E224).
#include <algorithm>
#include <cmath>

#include "beamforming/display/display_plan_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr double steps_of_cell = 192;  // positions in a cell at which the parts of an echo in its fields are tabulated
constexpr double shared_by_hats = pi / 8;  // mean of sqrt(s (1 - s)): amplitude that fields of two thirds share
constexpr double least_edge = 1.0 / 32;    // half the way from one cell to the next, in cells

}  // namespace

FieldShares::FieldShares(double likeness) {
  const double parts = static_cast<double>(field_parts), shared = shared_by_hats * shared_by_hats;
  // Outer fields of cells side by side share echoes.
  const double squares = parts + 2 * (parts - 1) * shared;  // sum over pairs of a cell's fields of their correlations
  edge = std::clamp(std::sqrt(likeness * squares / shared) / (2 * parts), least_edge, 0.5 / parts);
  per_cell = static_cast<float>(steps_of_cell);
  // One step more at both ends, for rounding.
  const auto steps = static_cast<std::size_t>(std::ceil((1 + 2 * edge) * steps_of_cell)) + 2;
  for (std::size_t k = 0; k < steps; ++k) {
    const double place = (static_cast<double>(k) - 0.5) / steps_of_cell - edge;  // in cells
    const double within = std::clamp(std::min(0.5 + 0.5 * place / edge, 0.5 + 0.5 * (1 - place) / edge), 0.0, 1.0);
    const double between = std::clamp(place * parts - 0.5, 0.0, parts - 1);
    const auto first = std::min(static_cast<std::size_t>(between), field_parts - 2);
    const double far = between - static_cast<double>(first);
    share.push_back({static_cast<float>(std::sqrt(within * (1 - far))), static_cast<float>(std::sqrt(within * far)),
                     static_cast<std::uint32_t>(first)});
  }
}

}  // namespace insonify
