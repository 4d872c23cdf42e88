// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/pose.hpp"
#include "sampling/scatterers.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Sampling of the range axis by the rays of a ping. At grazing incidence neighbouring rays hit a surface at distant
/// ranges, and range cells between them receive no echo although the surface is continuous.
struct RangeGaps {
  std::size_t cells = 0;  ///< range cells between neighbouring rays that hit one surface, over all beams
  std::size_t empty = 0;  ///< such cells without a hit of the beam
  double widest = 0;      ///< longest run of empty cells [m]

  /// Adds the counts of other beams and keeps the widest gap.
  void add(const RangeGaps& other);
};

/// Hit of one ray of a beam.
struct SurfaceHit {
  std::uint32_t ray = 0;     ///< number of the ray, upwards in elevation
  double range = 0;          ///< [m]
  Eigen::Vector3f position;  ///< in head axes [m]
  Eigen::Vector3f normal;    ///< unit vector, away from the head
  float spacing = 0;         ///< surfel spacing at the hit [m]
};

/// Returns true if both hits are on one surface: the chord between them lies in the plane of the mean normal within the
/// spacing plus 5 % of its length, as on a plane or a circular arc, and the normals are less than 45 degrees apart.
bool on_one_surface(const SurfaceHit& a, const SurfaceHit& b);

/// Counts the gaps between the hits of one beam, in the order of its rays, for range cells of `cell` [m], > 0.
RangeGaps count_range_gaps(const std::vector<SurfaceHit>& hits, double cell);

/// Counts the gaps between the rays of find_scatterers over all beams; `scatterers` is its result for `scene`,
/// `world_from_head` and `rays_per_beam`. Throws Error unless rays_per_beam >= 1 and cell is finite and > 0.
RangeGaps count_range_gaps(const SceneCloud& scene, const Pose& world_from_head, const Scatterers& scatterers,
                           int rays_per_beam, double cell);

/// Returns one sentence with a remedy if more than 1 % of the cells are empty, else nothing.
std::vector<std::string> range_gap_notes(const RangeGaps& gaps, int rays_per_beam, double cell);

}  // namespace insonify
