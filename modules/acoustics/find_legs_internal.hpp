// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "acoustics/boundary_count.hpp"
#include "acoustics/boundary_internal.hpp"

namespace insonify {

/// Legs from the head to a surfel: bit 0 direct, bit 1 + b by boundary b.
using LegSet = std::uint64_t;
constexpr LegSet direct_leg = 1;
constexpr LegSet leg_by(std::size_t boundary) { return LegSet{2} << boundary; }
static_assert(leg_by(most_boundaries - 1) != 0);

struct FoundLegs {
  std::vector<LegSet> legs;  ///< one entry per surfel of the scene
  std::size_t hidden = 0;    ///< legs by a boundary that the scene hides
};

/// Margin in elevation on either side of the fan in which legs are searched [rad].
double extent_of_legs(const EchoOptions& echo_options);

/// Finds the legs by the boundaries; and the direct legs to the surfels found, besides those marked in
/// `seen_directly`.
FoundLegs find_legs(const SceneCloud& scene, const View& view, const std::vector<Boundary>& boundaries,
                    const std::vector<std::uint8_t>& seen_directly);

}  // namespace insonify
