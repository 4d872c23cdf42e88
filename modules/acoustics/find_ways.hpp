#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "acoustics/boundary.hpp"

namespace insonify {

/// Which ways lead from the head to a surfel: bit 0 direct, bit 1 + b by boundary b.
using Ways = std::uint8_t;
constexpr Ways direct_way = 1;
constexpr Ways way_by(std::size_t boundary) { return static_cast<Ways>(2u << boundary); }

struct FoundWays {
  std::vector<Ways> ways;  ///< one entry per surfel of the scene
  std::size_t hidden = 0;  ///< ways by a boundary that the scene hides
};

/// How far a boundary's images, or direct places that belong to them, may stand for an echo inside the gate.
RangeGate gate_of_images(const View& view, const std::vector<Boundary>& boundaries, double pulse_margin);

/// Elevations on either side of the fan's in which ways are looked for [rad].
double extent_of_ways(const HearingOptions& hearing);

/// Finds the ways by the boundaries; and the direct ways to the surfels found, besides those marked in
/// `seen_directly`.
FoundWays find_ways(const SceneCloud& scene, const View& view, const std::vector<Boundary>& boundaries,
                    const std::vector<std::uint8_t>& seen_directly);

}  // namespace insonify
