// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>

#include "scene/material.hpp"

namespace insonify {

/// Numbers that a material had when the formats of scenes were made: all files hold these.
inline constexpr std::size_t first_material_numbers = 3;

/// How many of material_numbers, from the first on, say all of some materials: the others have their defaults. So files
/// of materials without newer numbers have the bytes that they always had.
inline std::size_t numbers_said(std::span<const Material> materials) {
  std::size_t said = first_material_numbers;
  for (const Material& m : materials)
    for (std::size_t k = said; k < std::size(material_numbers); ++k)
      if (m.*material_numbers[k].member != Material{}.*material_numbers[k].member) said = k + 1;
  return said;
}

}  // namespace insonify
