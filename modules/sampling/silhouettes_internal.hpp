// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "sampling/insonified_region.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Returns 1 for each surfel of a cut beside which a surface ends as the head sees it: of two neighbouring directions
/// one sees the surfel, and the other something that lies apart and deeper than the hiding depth behind its surface, or
/// before it (E172).
///
/// least_cell   directions are so far apart [rad], or farther: at most 8 directions for each surfel, or 2^20
std::vector<std::uint8_t> at_silhouettes(const SceneCloud& cut, const InsonifiedRegion& region, double least_cell,
                                         int threads);

}  // namespace insonify
