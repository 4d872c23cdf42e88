// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>

namespace insonify {

/// Bits of each coordinate that a Morton code holds.
inline constexpr int morton_bits = 21;

/// Returns the number of a cubic cell along a Morton curve, by interleaving the low 21 bits of its three coordinates:
/// bit k of coordinate a becomes bit 3 k + a. Cells with adjacent numbers are neighbours, and code >> 3 is the code of
/// the cell of twice the width that holds this one.
inline std::uint64_t morton_code(const std::array<std::uint32_t, 3>& cell) {
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    // Inserts two zero bits after each bit.
    std::uint64_t v = cell[static_cast<std::size_t>(axis)] & 0x1fffff;
    v = (v | v << 32) & 0x001f00000000ffff;
    v = (v | v << 16) & 0x001f0000ff0000ff;
    v = (v | v << 8) & 0x100f00f00f00f00f;
    v = (v | v << 4) & 0x10c30c30c30c30c3;
    v = (v | v << 2) & 0x1249249249249249;
    code |= v << axis;
  }
  return code;
}

}  // namespace insonify
