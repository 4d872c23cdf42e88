#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/gate_surfels_internal.hpp"
#include "sampling/scatterers.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

struct SplitOptions {
  double scatterers_per_cell = 10;  ///< 0: never split
  double range_resolution = 0;      ///< length of a cell [m]
  double beam_width = 0;            ///< width of a cell [rad]
  std::uint64_t seed = 1;
  int threads = 0;
  double row_width = 0;  ///< height of a cell for a planar array [rad]; 0: unlimited
};

/// Area of a resolution cell on a surface [m^2] (E17), as explained below.
double cell_area(double range, double cos_incidence, const SplitOptions& options);

/// Returns the number of parts that gives `scatterers_per_cell` scatterers per resolution cell (E17):
///
///   parts = ceil(scatterers_per_cell area / (length width)), 1 .. 4096
///   width = range beam_width, length = min(dr / sin(incidence), 2 sqrt(2 range dr))
///
/// The second length is the extent of a plane at normal incidence within dr. For a planar array the cell is limited by
/// the cross-section of the beam: it is the smaller of range^2 beam_width row_width / cos_incidence and of length x
/// range x the narrower of both widths.
std::uint32_t parts_of(double area, double range, double cos_incidence, const SplitOptions& options);

/// The number of the first part of each surfel, and at the end that of all parts.
struct PartCounts {
  std::vector<std::size_t> first;
  std::size_t capped = 0;  ///< surfels that would need more than 4096 parts
};
/// Counts the parts of the given surfels (indices in the scene). Throws Error for more than 2^28.
PartCounts count_parts(const SceneCloud& scene, const HeadFrame& head, std::span<const std::uint32_t> surfels,
                       const SplitOptions& options);

/// Returns the scatterers of the given surfels, `first` as counted for them, in order. Part 0 is at the surfel's centre;
/// part k is point k of a low-discrepancy sequence over a disc of the surfel's area in its tangent plane, shifted and
/// rotated by random numbers of (seed, surfel id): at the same position in the scene for every pose.
Scatterers split_surfels(const SceneCloud& scene, const HeadFrame& head, std::span<const std::uint32_t> surfels,
                         std::span<const std::size_t> first, const SplitOptions& options);

}  // namespace insonify
