// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <optional>

#include <Eigen/Core>

#include "core/pose.hpp"
#include "sampling/scatterers.hpp"
#include "scene/prepared_scene.hpp"
#include "scene/scene_cloud.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// Unit of the scene that a scatterer represents.
enum class SamplingKind {
  surfels,  ///< every visible surfel is a scatterer with its true area
  rays      ///< a fixed number of rays per beam, each with its solid angle
};

/// Method that finds the surfels in a direction. The choice affects the cost, not the result: each method proposes
/// candidates, and one hit rule decides.
enum class Projection {
  kdtree,       ///< KD-trees over the directions of the surfels
  brute_force,  ///< reference: every surfel is tested against every direction
  raster,       ///< footprints rasterised over directions with a depth buffer
  automatic     ///< raster or kdtree, by estimated cost
};

/// The energy that a head receives from surfels.
class SurfelEnergy {
 public:
  virtual ~SurfelEnergy() = default;
  /// Returns the energy of a surfel, in any unit: `position` in head axes [m], cosine of its angle of incidence, area
  /// [m^2], index of its material. Several threads call it at once.
  virtual double of(const Eigen::Vector3d& position, double cosine, double area, std::size_t material) const = 0;
};

/// Options of find_scatterers.
struct SamplingOptions {
  SamplingKind kind = SamplingKind::surfels;
  Projection projection = Projection::automatic;
  double scatterers_per_cell = 8;  ///< target number per resolution cell, reached by splitting surfels; 0: never split
  double range_resolution = 0;     ///< length of a resolution cell [m]; 0: two bins of the gate
  int rays_per_beam = 64;          ///< number of rays, jittered within the beam's share of the sector
  double elevation_half_extent = 0;  ///< margin above and below the fan [rad]; 0: elevation_width of the fan
  double footprint = 1.2;            ///< radius of a surfel's disc in units of its spacing sqrt(area)
  bool occlusion = true;             ///< false: nothing is hidden (for tests and closed forms)
  std::uint64_t seed = 1;            ///< seeds the jitter of parts and rays
  int threads = 0;                   ///< 0: all cores
  double relief_outer_scale = 0;     ///< longest wavelength of micro-relief [m]; 0: the mean surfel spacing sqrt(area)
  double azimuth_margin = 0;         ///< margin beyond the outermost beams, in u; 0: 1.5 beam widths
  /// Surfels up to this distance from the main lobes, in u and v, are split as finely as inside them (E17); 2: all.
  double lobe_margin = 0;
  /// Fractions of energy (E127) are taken within this sector, so that they do not depend on the margin that is sampled
  /// beyond. Surfels beyond the cones or elevations of this sector take fractions of the energy from inside and from
  /// there. Empty: fractions of all energy.
  std::optional<Sector> inner_sector{};
  /// Surfels that return little of the energy from their range (for a fan, from their range and u) are split less
  /// (E127). Empty: energy does not count.
  std::shared_ptr<const SurfelEnergy> energy{};
};

/// Returns the sector that these options sample: the sector of the fan, extended beyond its outermost beams by the
/// azimuth margin and the elevation half extent; where those are 0, by one beam width and the elevation width.
Sector insonified_sector(const BeamFan& fan, const SamplingOptions& options);

/// Counts of the sampling, for log and manifest.
struct SamplingReport {
  std::size_t surfels = 0;      ///< in the scene
  std::size_t merged_to = 0;    ///< surfels and nodes that stand for those within reach (E137); 0: none are merged
  std::size_t in_gate = 0;      ///< inside sector and range gate
  std::size_t back_facing = 0;  ///< surfels in the gate that face away from the head
  std::size_t hidden = 0;       ///< surfels in the gate that are hidden behind others; 0 for rays
  std::size_t visible = 0;      ///< the remaining surfels; for rays: distinct surfels hit
  std::size_t rays_missed = 0;  ///< rays that hit no surfel
  std::size_t scatterers = 0;   ///< number after splitting
  std::size_t capped = 0;       ///< visible surfels that would need more than 4096 parts
  /// Rays of rays_missed that are surrounded by surfels within three footprints: probably a hole in the scan (an
  /// opening up to about seven spacings wide) rather than open water.
  std::size_t rays_unknown = 0;
  Projection projection = Projection::automatic;  ///< the method used; automatic: none was needed
  std::size_t sparse_beams = 0;  ///< beams whose main lobe holds fewer than four of most surfels that they see
};

/// Result of find_scatterers.
struct Sampling {
  Scatterers scatterers;
  SamplingReport report;
};

/// Returns the patches of `scene` that are visible from a head at `world_from_head` within fan and gate (E16, E17), in
/// head axes, with a report of the counts.
///
/// A surfel hides what its footprint covers. A ray hits the front cluster of the surfels whose footprints contain its
/// direction; its range is that of the tangent plane of the member nearest in angle. A surfel is visible unless the
/// disc of another surfel covers it and lies in front of it by more than the roughness of a surface.
///
/// Rays tile the insonified sector: the share of a beam ends at the midpoints to its neighbours or at the edge of the
/// sector. The projected area of a ray is r^2 times its solid angle.
///
/// Where a material has a relief_slope, incidence and projected area are those of facets tilted by micro-relief (E52);
/// visibility is still decided by the smooth surfels. The relief is fixed in the world, so a position keeps its slope
/// from ping to ping and for every splitting.
///
/// Without micro-relief the result depends on relative position only: translating world and head together gives the
/// same scatterers (rotating them rotates the parts within their surfels). The result does not depend on `threads`. An
/// empty view gives no scatterers. Throws Error for an invalid scene, fan, gate, pose or option.
Sampling find_scatterers(const SceneCloud& scene, const Pose& world_from_head, const BeamFan& fan,
                         const RangeGate& gate, const SamplingOptions& options = {});

/// Returns the same bytes for a scene prepared once for many pings, at a cost that grows with the insonified region
/// instead of the scene.
Sampling find_scatterers(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan,
                         const RangeGate& gate, const SamplingOptions& options = {});

}  // namespace insonify
