#pragma once
#include <cstdint>

#include "core/pose.hpp"
#include "sampling/beam_fan.hpp"
#include "sampling/range_gate.hpp"
#include "sampling/scatterers.hpp"
#include "scene/prepared_scene.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

enum class SamplingKind {
  surfels,  ///< every visible surfel is a scatterer with its true area
  rays      ///< a fixed number of rays per beam, each with its solid angle
};

/// How surfels are found that stand in one direction. It changes the cost, not the result: all of them propose
/// surfels, and the same hit rule decides.
enum class Projection {
  kdtree,       ///< KD-trees over the directions of the surfels
  brute_force,  ///< the referee: every surfel against every direction, with the same hit rule
  raster,       ///< footprints rasterised over directions, with a depth buffer
  automatic     ///< raster or kdtree, whichever costs less here
};

struct SamplingOptions {
  SamplingKind kind = SamplingKind::surfels;
  Projection projection = Projection::automatic;
  double scatterers_per_cell = 10;   ///< surfels are split until a resolution cell holds so many; 0: never split
  double range_resolution = 0;       ///< [m], length of a cell; 0: two bins of the gate
  int rays_per_beam = 64;            ///< for rays: jittered in azimuth and elevation inside the beam's own share
  double elevation_half_extent = 0;  ///< [rad] kept above and below the fan's elevation; 0: the elevation width
  double footprint = 1.2;            ///< radius of a surfel's disc in units of its spacing sqrt(area)
  bool occlusion = true;             ///< false: everything is seen (for tests and closed forms)
  std::uint64_t seed = 1;            ///< of the jitter of parts and rays
  int threads = 0;                   ///< 0: all cores
  double relief_outer_scale = 0;     ///< longest wavelength of micro-relief [m]; 0: the mean surfel spacing sqrt(area)
  double azimuth_margin = 0;         ///< kept beyond the outermost beams, in u; 0: 1.5 beam widths
};

/// What sampling met on its way, for the log and the manifest.
struct SamplingReport {
  std::size_t surfels = 0;      ///< in the scene
  std::size_t in_gate = 0;      ///< inside sector and range gate
  std::size_t back_facing = 0;  ///< of these, turned away
  std::size_t hidden = 0;       ///< of these, behind others; 0 for rays
  std::size_t visible = 0;      ///< the rest; for rays: surfels that a ray met
  std::size_t rays_missed = 0;  ///< rays that met nothing
  std::size_t scatterers = 0;   ///< after splitting
  std::size_t capped = 0;       ///< visible surfels that would need more than 4096 parts
  /// Of rays_missed, those with surfels within three footprints on all sides: more likely a hole in the scan (an opening
  /// less than about seven spacings wide) than open water.
  std::size_t rays_unknown = 0;
  Projection projection = Projection::automatic;  ///< the one used; automatic: none was needed
};

struct Sampling {
  Scatterers scatterers;
  SamplingReport report;
};

/// The patches of `scene` that a head at `world_from_head` sees inside fan and gate (E16, E17).
///
/// Every surfel shadows exactly its own footprint. Hit rule: of the surfels whose footprint holds a direction, the front
/// cluster counts, and the range is where the direction meets the tangent plane of its angularly nearest member.
/// A surfel is visible when no surfel's disc stands before it by more than the roughness of one surface.
///
/// Rays tile the insonified sector: a beam's share goes to the midpoints between neighbours, the outermost ones' to
/// the edge of the sector. The cell of a ray is r^2 times its share of solid angle.
///
/// Where a material has a relief_slope, incidence and projected area are those of facets tilted by micro-relief (E52);
/// what is visible is still decided by the smooth surfels. The relief belongs to the world, so that a place keeps its
/// slope from ping to ping and for every splitting.
///
/// Without micro-relief only relative position counts: world and head moved together give the same scatterers (turned
/// together, the parts of split surfels turn within their surfels). The result does not depend on `threads`. Throws Error for an
/// invalid scene, fan, gate, pose or option. Nothing in view: no scatterers.
Sampling find_scatterers(const SceneCloud& scene, const Pose& world_from_head, const BeamFan& fan,
                         const RangeGate& gate, const SamplingOptions& options = {});

/// The same from a scene that was checked and put into blocks once, for many pings: the same bytes, at a cost that grows
/// with what the fan reaches, not with the scene.
Sampling find_scatterers(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan,
                         const RangeGate& gate, const SamplingOptions& options = {});

}  // namespace insonify
