// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "core/target_clones.hpp"
#include "core/vector_functions.hpp"
#include "sampling/visibility_loops_internal.hpp"

namespace insonify::kernels {
namespace {

constexpr std::size_t lanes = visibility_lanes;

/// Tells which of the surfels from `at` on may lie behind the disc, by 1 or 0 each; returns whether some may.
INSONIFY_ALWAYS_INLINE bool test_behind(const OpenSurfels& open, const HidingDisc& disc, std::size_t at,
                                        std::int32_t (&behind)[lanes]) {
  constexpr float less = 0.9999f;
  const float *const px = open.x + at, *const py = open.y + at, *const pz = open.z + at;
  const float *const uneven = open.unevenness + at, *const noisy = open.noise + at, *const rounded = open.rounding + at;
  std::int32_t some = 0;
#pragma GCC unroll 1
#pragma GCC ivdep
  for (std::size_t l = 0; l < lanes; ++l) {
    const float x = px[l], y = py[l], z = pz[l], rounding = rounded[l];
    const float unevenness = uneven[l] > disc.unevenness ? uneven[l] : disc.unevenness,
                noise = noisy[l] > disc.noise ? noisy[l] : disc.noise;
    const float depth = disc.away[0] * x + disc.away[1] * y + disc.away[2] * z;
    // Where the line of sight crosses the plane, from the disc's centre, times the depth.
    const float miss_x = disc.position[0] * depth - x * disc.plane_distance,
                miss_y = disc.position[1] * depth - y * disc.plane_distance,
                miss_z = disc.position[2] * depth - z * disc.plane_distance;
    const float reach = disc.reach * depth + rounding * disc.plane_distance;
    const bool deeper = depth - disc.plane_distance + rounding > less * (unevenness + 3 * noise);
    const bool through = miss_x * miss_x + miss_y * miss_y + miss_z * miss_z <= reach * reach;
    behind[l] = deeper & through ? 1 : 0;
    some |= behind[l];
  }
  return some != 0;
}

}  // namespace

INSONIFY_CLONES std::size_t list_behind(const OpenSurfels& open_surfels, const HidingDisc& hiding,
                                        const std::uint32_t* first, const std::uint32_t* end, std::size_t rows,
                                        std::uint32_t* found) {
  const OpenSurfels open = open_surfels;
  const HidingDisc disc = hiding;
  std::size_t count = 0;
  for (std::size_t k = 0; k < rows; ++k)
    for (std::uint32_t at = first[k]; at < end[k]; at += lanes) {
      std::int32_t behind[lanes];
      if (!test_behind(open, disc, at, behind)) continue;
      for (std::uint32_t l = 0; l < lanes; ++l) found[count] = at + l, count += static_cast<std::size_t>(behind[l]);
    }
  return count;
}

INSONIFY_CLONES void raise_cells(float* cells, std::size_t stride, std::size_t columns, std::size_t rows,
                                 const CellPlane& plane) {
  const auto [start, along_x, along_y] = plane;
  const auto count = static_cast<std::int32_t>(columns);
  for (std::size_t y = 0; y < rows; ++y) {
    const float row = start + along_y * static_cast<float>(static_cast<std::int32_t>(y));
    for (std::int32_t x = 0; x < count; x += static_cast<std::int32_t>(lanes)) {
      float* const at = cells + y * stride + static_cast<std::size_t>(x);
#pragma GCC unroll 1
#pragma GCC ivdep
      for (std::int32_t l = 0; l < static_cast<std::int32_t>(lanes); ++l) {
        const float value = row + along_x * static_cast<float>(x + l), here = at[l];
        at[l] = (x + l < count) & (value > here) ? value : here;
      }
    }
  }
}

}  // namespace insonify::kernels
