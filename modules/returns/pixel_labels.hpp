// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/grid.hpp"

namespace insonify {

/// What surface every pixel of a ping shows, beams x bins.
struct PixelLabels {
  static constexpr std::uint16_t nothing = 0xffff;  ///< no surface of the scene in this cell
  static constexpr std::uint16_t shadow = 0xfffe;   ///< surface in this cell, none of which the head sees
  static constexpr std::uint32_t no_id = 0xffffffff;

  Grid<std::uint16_t> material;    ///< index into names, or nothing or shadow
  Grid<std::uint32_t> id;          ///< of the strongest surfel of that material in this cell; no_id if there is none
  Grid<float> share;               ///< of the pixel's energy that is of that material and in the main lobe; else 0
  std::vector<std::string> names;  ///< of the materials

  /// Whether there are no labels.
  bool empty() const { return material.size() == 0; }
};

/// The material of every pixel; nothing where less than `least_share` of the energy is of one material in the pixel's
/// own cell, i.e. where side lobes or multipath are stronger.
Grid<std::uint16_t> material_image(const PixelLabels& labels, double least_share = 0.5);

/// The id of the strongest surfel of every pixel, by the same rule; no_id elsewhere.
Grid<std::uint32_t> id_image(const PixelLabels& labels, double least_share = 0.5);

}  // namespace insonify
