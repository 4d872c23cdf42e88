#pragma once
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "sampling/find_scatterers.hpp"
#include "sampling/gate_surfels_internal.hpp"
#include "scene/scene_index.hpp"

namespace insonify {

/// Finds the surfels that may stand in a direction: KD-trees over the directions of the gated surfels, one
/// per octave of angular footprint (disc radius / range), each searched with its own widest footprint.
/// Surfels that fill more than 30 degrees to either side, or all with Projection::brute_force, are looked at
/// one by one.
class DirectionIndex {
 public:
  DirectionIndex(const std::vector<GatedSurfel>& surfels, Projection projection, int threads);

  /// Calls test(surfel) for the surfels that may stand in `direction`, among them all that do and are nearer
  /// than `range`, until one call returns true; returns whether one did. `scratch` is overwritten.
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
    SceneIndex index;                    // over their directions
    float chord = 0;                     // no member's footprint is wider
    float nearest = 0;                   // no member's disc comes nearer [m]
  };

  std::vector<std::uint32_t> wide_;
  std::vector<Octave> octaves_;  // widest footprints first
};

}  // namespace insonify
