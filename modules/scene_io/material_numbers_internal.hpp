// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>

#include "scene/material.hpp"

namespace insonify {

/// Numbers that every file holds: those that a material had in the first version of the formats.
inline constexpr std::size_t first_material_numbers = 3;

/// Returns the count of leading material_numbers that describe these materials fully; all later numbers have their
/// defaults. Files of materials without newer numbers thus keep their bytes.
inline std::size_t numbers_said(std::span<const Material> materials) {
  std::size_t said = first_material_numbers;
  for (const Material& m : materials)
    for (std::size_t k = said; k < std::size(material_numbers); ++k)
      if (m.*material_numbers[k].member != Material{}.*material_numbers[k].member) said = k + 1;
  return said;
}

}  // namespace insonify
