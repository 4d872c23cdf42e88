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

/// How well the rays of a ping fill the range axis. On a surface seen at grazing incidence neighbouring rays meet far
/// apart: cells of range between them hold no echo, although the surface goes on.
struct RangeGaps {
  std::size_t cells = 0;  ///< range cells between neighbouring rays that met one surface, over all beams
  std::size_t empty = 0;  ///< of these, cells where no ray of the beam met anything
  double widest = 0;      ///< longest run of empty cells [m]

  void add(const RangeGaps& other);
};

/// Where one ray of a beam met the scene.
struct SurfaceHit {
  std::uint32_t ray = 0;     ///< rays of a beam are counted upwards in elevation
  double range = 0;          ///< [m]
  Eigen::Vector3f position;  ///< in head axes [m]
  Eigen::Vector3f normal;    ///< unit vector, away from the head
  float spacing = 0;         ///< of the cloud there [m]
};

/// True if the step from one hit to the other runs along a surface: the chord lies in the plane of the mean normal
/// within the cloud's spacing and 5 % of its length, as it does on a plane and on an arc of a circle, and the normals
/// are less than 45 degrees apart.
bool on_one_surface(const SurfaceHit& a, const SurfaceHit& b);

/// Gaps between the hits of one beam, in the order of its rays, for range cells of `cell` [m], > 0.
RangeGaps count_range_gaps(const std::vector<SurfaceHit>& hits, double cell);

/// Gaps that the rays of find_scatterers left, over all beams: `scatterers` as it gave them for `scene`,
/// `world_from_head` and `rays_per_beam`. Throws Error unless rays_per_beam >= 1 and cell is finite and > 0.
RangeGaps count_range_gaps(const SceneCloud& scene, const Pose& world_from_head, const Scatterers& scatterers,
                           int rays_per_beam, double cell);

/// One sentence with a remedy if more than 1 % of the cells are empty; else none.
std::vector<std::string> range_gap_notes(const RangeGaps& gaps, int rays_per_beam, double cell);

}  // namespace insonify
