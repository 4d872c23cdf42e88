#include "sampling/surfel_visibility.hpp"

#include "core/parallel.hpp"
#include "sampling/hit_rule.hpp"

namespace insonify {

std::vector<std::uint8_t> find_hidden(const std::vector<GatedSurfel>& surfels, const DirectionIndex& index,
                                      int threads) {
  std::vector<std::uint8_t> hidden(surfels.size(), 0);
  parallel_blocks(surfels.size(), 2048, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> scratch;
    for (std::size_t i = begin; i < end; ++i) {
      const GatedSurfel& s = surfels[i];
      if (!s.in_gate || !s.facing) continue;
      // A surfel cannot hide itself: it does not lie behind its own tangent plane.
      hidden[i] = index.any(s.position / s.range, s.range, scratch,
                            [&](std::uint32_t other) { return hides(surfels[other], s); });
    }
  });
  return hidden;
}

}  // namespace insonify
