// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "sampling/find_scatterers.hpp"
#include "sampling/gate_surfels_internal.hpp"
#include "scene/scene_index.hpp"

namespace insonify {

/// Finds the surfels whose footprint may contain a direction, as one KD-tree query per octave of angular size: the unit
/// vectors towards the gated surfels are grouped by angular radius (disc radius / range) into octaves, one KD-tree
/// each, and each tree is searched with the chord of its widest footprint. Surfels with a half-angle above 30 degrees,
/// or all of them for Projection::brute_force, are tested one by one. Building costs O(n log n), a query O(log n) per
/// octave plus the surfels found.
class DirectionIndex {
 public:
  /// reach   distance from its centre within which a surfel is found, in radii of its disc
  DirectionIndex(const GatedSurfels& surfels, Projection projection, float reach, int threads);

  /// Calls test(surfel) for candidates in `direction`, among them all surfels that cover it and are nearer than `range`
  /// [m], until a call returns true; returns whether one did. `scratch` is overwritten.
  template <typename Test>
  bool any(const Eigen::Vector3f& direction, float range, std::vector<Neighbour>& scratch, Test&& test) const {
    for (const std::uint32_t s : wide_)
      if (test(s)) return true;
    for (const Octave& octave : octaves_) {
      if (octave.nearest >= range) continue;
      octave.index.find_within(direction, octave.chord, scratch);
      for (const Neighbour& n : scratch)
        if (test(octave.members[n.index])) return true;
    }
    return false;
  }

 private:
  struct Octave {
    std::vector<std::uint32_t> members;  // gated surfels, in the order of the tree's points
    SceneIndex index;                    // of their directions
    float chord = 0;                     // chord of the widest footprint
    float nearest = 0;                   // lower bound on the range of the discs [m]
  };

  std::vector<std::uint32_t> wide_;
  std::vector<Octave> octaves_;  // widest footprints first
};

}  // namespace insonify
