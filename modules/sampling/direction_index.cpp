// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/parallel.hpp"
#include "sampling/direction_index_internal.hpp"
#include "sampling/hit_rule_internal.hpp"

namespace insonify {
namespace {

constexpr float widest_indexed = 0.5f;  // sine of the footprint's half-angle
// Directions are rounded to single precision, so the search is slightly wider than the footprint.
constexpr float chord_slack = 1e-6f, chord_factor = 1.0001f, nearest_factor = 0.9999f;

}  // namespace

DirectionIndex::DirectionIndex(const GatedSurfels& surfels, Projection projection, float reach, int threads) {
  std::map<int, std::vector<std::uint32_t>, std::greater<>> members;
  for (std::uint32_t s = 0; s < surfels.size(); ++s) {
    const float sine = reach * surfels[s].radius / surfels[s].range;
    if (!(sine > 0)) continue;  // no area: occludes nothing
    if (projection == Projection::brute_force || sine > widest_indexed)
      wide_.push_back(s);
    else
      members[std::ilogb(sine)].push_back(s);
  }

  for (auto& [octave, list] : members) {
    octaves_.push_back({{}, SceneIndex({}), 0, std::numeric_limits<float>::max()});
    octaves_.back().members = std::move(list);
  }
  parallel_for(octaves_.size(), threads, [&](std::size_t o) {
    Octave& octave = octaves_[o];
    std::vector<Eigen::Vector3f> directions;
    directions.reserve(octave.members.size());
    float chord = 0;
    for (const std::uint32_t s : octave.members) {
      directions.push_back(surfels[s].position / surfels[s].range);
      chord = std::max(chord, squared_chord_of(reach * surfels[s].radius / surfels[s].range));
      octave.nearest = std::min(octave.nearest, (surfels[s].range - reach * surfels[s].radius) * nearest_factor);
    }
    octave.chord = std::sqrt(chord) * chord_factor + chord_slack;
    octave.index = SceneIndex(directions);
  });
}

}  // namespace insonify
