// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/trust_lines_of_sight.hpp"

#include <algorithm>
#include <limits>

#include "core/parallel.hpp"
#include "sampling/direction_index_internal.hpp"
#include "sampling/gate_surfels_internal.hpp"
#include "sampling/hit_rule_internal.hpp"
#include "sampling/insonified_region.hpp"

namespace insonify {
namespace {

// A surfel and the noise with which it would not cover a line of sight.
struct Contradiction {
  std::uint32_t surfel;
  float noise;
};

}  // namespace

void trust_lines_of_sight(const Eigen::Vector3d& viewpoint, int threads, SceneCloud& scene,
                          std::span<const std::uint16_t> stations, std::uint16_t station) {
  scene.noise.resize(scene.size(), 0.0f);
  const InsonifiedRegion all = region_around(viewpoint, std::numeric_limits<float>::max());
  const auto surfels =
      gate_surfels(scene, HeadFrame(scene, all.world_from_head), all.sector, all.gate, all.footprint, threads);
  const DirectionIndex index(surfels, Projection::kdtree, hiding_reach, threads);

  constexpr std::size_t block = 2048;
  std::vector<std::vector<Contradiction>> found((surfels.size() + block - 1) / block);
  parallel_blocks(surfels.size(), block, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> scratch;
    std::vector<Contradiction> covering;
    for (std::size_t i = begin; i < end; ++i) {
      if (!stations.empty() && stations[surfels[i].surfel] != station) continue;
      const LineOfSight line(surfels[i]);
      Cover covers = 0;
      covering.clear();
      index.any(line.along, surfels[i].range, scratch, [&](std::uint32_t other) {
        const GatedSurfel& front = surfels[other];
        const Cover here = cover(front, line);
        covers |= here;
        // Three standard deviations and a little: deeper than what is to be seen.
        const float depth = front.away.dot(surfels[i].position) - front.plane_distance;
        if (here != 0) covering.push_back({front.surfel, 0.334f * depth});
        return false;
      });
      if (hides(covers)) found[begin / block].insert(found[begin / block].end(), covering.begin(), covering.end());
    }
  });
  for (const auto& sublist : found)
    for (const Contradiction& c : sublist) scene.noise[c.surfel] = std::max(scene.noise[c.surfel], c.noise);
}

}  // namespace insonify
