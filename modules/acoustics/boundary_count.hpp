// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

namespace insonify {

/// Largest number of planes that the echoes of one ping may bounce off.
inline constexpr std::size_t most_boundaries = 63;
/// Largest number of mirrors of an environment, beside the six planes of a tank, or surface and bottom.
inline constexpr std::size_t most_mirrors = most_boundaries - 6;
/// Largest number of corners of a mirror.
inline constexpr std::size_t most_corners = 64;

}  // namespace insonify
