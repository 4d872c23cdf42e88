#pragma once
#include <cstdint>
#include <vector>

#include "sampling/gate_surfels_internal.hpp"
#include "sampling/scatterers.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

struct SplitOptions {
  double scatterers_per_cell = 10;  ///< 0: never split
  double range_resolution = 0;      ///< length of a cell [m]
  double beam_width = 0;            ///< its width [rad]
  std::uint64_t seed = 1;
  int threads = 0;
  double row_width = 0;  ///< its height [rad] for a planar array; 0: as high as the surface goes
};

/// Number of parts that put `scatterers_per_cell` of them in one resolution cell (E17):
///
///   parts = ceil(scatterers_per_cell area / (length width)), 1 .. 4096
///   width = range beam_width, length = min(dr / sin(incidence), 2 sqrt(2 range dr))
///
/// The second length is what a plane at normal incidence shows within dr. A planar array sees no more of a surface
/// than its beam's cross-section, range^2 beam_width row_width / cos_incidence, and a slice of it that may lie along
/// either side: the cell is the smaller of that and of length x range x the narrower of both widths.
std::uint32_t parts_of(double area, double range, double cos_incidence, const SplitOptions& options);

/// Scatterers of the given surfels (indices in the scene), in order. Part 0 is the surfel's centre; part k
/// stands where the k-th point of a low-discrepancy sequence over the surfel's disc (of its area, in its
/// tangent plane) falls, turned by a number bound to (seed, surfel id): at the same place in the scene for
/// every pose. Throws Error if that makes more than 2^28 scatterers.
struct SplitSurfels {
  Scatterers scatterers;
  std::size_t capped = 0;  ///< surfels that would need more than 4096 parts
};
SplitSurfels split_surfels(const SceneCloud& scene, const HeadFrame& head, const std::vector<std::uint32_t>& surfels,
                           const SplitOptions& options);

}  // namespace insonify
