// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/find_holes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"
#include "sampling/beam_rays_internal.hpp"
#include "sampling/direction_candidates_internal.hpp"
#include "sampling/hit_rule_internal.hpp"

namespace insonify {
namespace {

constexpr float rim_footprints = 3;  // surfels around a hole are within this many footprints
constexpr float other_surface = 8;   // range gap between two surfaces, in spacings

// The gated surfels with their own footprints, and enlarged to span a hole.
struct FootprintSets {
  GatedSurfels own, enlarged;

  explicit FootprintSets(GatedSurfels surfels) : own(std::move(surfels)), enlarged(own) {
    for (GatedSurfel& s : enlarged) s.radius *= rim_footprints;
  }
};

// Returns the hole in the direction of a ray, if any; `candidates` may contain more than the surfels around it.
std::optional<Hole> hole_at(const FootprintSets& surfels, std::uint32_t beam, const Ray& ray,
                            std::vector<std::uint32_t>& candidates) {
  std::vector<std::uint32_t> around = candidates;
  RayHit hit;
  const RayOutcome outcome = hit_surface(surfels.own, ray.along, true, candidates, hit);
  if (outcome == RayOutcome::blocked) return {};
  // Only surfels clearly in front of the surface hit can form the rim of a hole.
  const float limit = outcome == RayOutcome::missed ? std::numeric_limits<float>::infinity()
                                                    : hit.range - other_surface * surfels.own[hit.surfel].spacing;
  keep_covering(ray.along, surfels.enlarged, around);
  std::erase_if(around, [&](std::uint32_t s) { return !(surfels.own[s].range < limit); });
  if (!is_surrounded(ray.along, surfels.own, around)) return {};
  const auto nearer = [&](std::uint32_t a, std::uint32_t b) { return surfels.own[a].range < surfels.own[b].range; };
  const auto [nearest, farthest] = std::minmax_element(around.begin(), around.end(), nearer);
  return Hole{beam, ray.direction.azimuth, ray.direction.elevation, surfels.own[*nearest].range,
              surfels.own[*farthest].range};
}

std::vector<std::optional<Hole>> search_along(const std::vector<Ray>& rays, const FootprintSets& surfels,
                                              const SamplingOptions& options) {
  std::vector<CubePoint> queries;
  for (const Ray& ray : rays) queries.push_back(on_cube(ray.along));
  std::vector<std::optional<Hole>> found(rays.size());
  for_candidates(surfels.enlarged, queries, options.threads,
                 [&](std::uint32_t q, std::vector<std::uint32_t>& candidates) {
                   const std::uint32_t beam = q / static_cast<std::uint32_t>(options.rays_per_beam);
                   found[q] = hole_at(surfels, beam, rays[q], candidates);
                 });
  return found;
}

void require_valid(const Pose& pose, const SamplingOptions& o) {
  if (!pose.matrix().allFinite()) fail(ErrorKind::argument, "find_holes: world_from_head must be finite");
  const auto require = [](bool good, const char* name, double value, const char* rule) {
    if (!good) fail(ErrorKind::argument, "find_holes: options.", name, " = ", value, ", must be ", rule);
  };
  require(o.rays_per_beam >= 1, "rays_per_beam", o.rays_per_beam, "at least 1");
  require(o.footprint > 0 && std::isfinite(o.footprint), "footprint", o.footprint, "> 0");
  require(o.elevation_half_extent >= 0 && std::isfinite(o.elevation_half_extent), "elevation_half_extent",
          o.elevation_half_extent, ">= 0 rad");
  require(o.azimuth_margin >= 0 && std::isfinite(o.azimuth_margin), "azimuth_margin", o.azimuth_margin, ">= 0 rad");
}

}  // namespace

Holes find_holes(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan, const RangeGate& gate,
                 const SamplingOptions& options) {
  require_valid(fan, "find_holes");
  require_valid(gate, "find_holes");
  require_valid(world_from_head, options);
  const Sector sector = insonified_sector(fan, options);
  const HeadFrame head(prepared.scene(), world_from_head);
  const FootprintSets surfels(gate_surfels(prepared, head, sector, gate, options.footprint, options.threads));
  const std::vector<Ray> rays = beam_rays(beam_cells(fan, sector), options);
  Holes result;
  result.directions = rays.size();
  if (surfels.own.empty()) return result;
  for (const std::optional<Hole>& hole : search_along(rays, surfels, options))
    if (hole) result.holes.push_back(*hole);
  return result;
}

std::vector<Eigen::Vector3d> hole_positions(const Holes& holes, const Pose& world_from_head) {
  std::vector<Eigen::Vector3d> positions;
  for (const Hole& hole : holes.holes)
    positions.push_back(world_from_head * Eigen::Vector3d(0.5 * (hole.min_range + hole.max_range) *
                                                          unit_vector({hole.azimuth, hole.elevation})));
  return positions;
}

Grid<std::uint8_t> mask_holes(const Holes& holes, const BeamFan& fan, const RangeGate& gate) {
  require_valid(fan, "mask_holes");
  require_valid(gate, "mask_holes");
  const auto bins = static_cast<double>(gate.bins());
  Grid<std::uint8_t> mask = Grid<std::uint8_t>::Zero(fan.beams(), gate.bins());
  for (const Hole& hole : holes.holes) {
    if (hole.beam >= fan.beams())
      fail(ErrorKind::argument, "mask_holes: beam = ", hole.beam, ", but there are ", fan.beams(), " beams");
    const double first = std::max(0.0, std::floor((hole.min_range - gate.min_range) / gate.bin_size));
    const double last = std::min(bins - 1, std::floor((hole.max_range - gate.min_range) / gate.bin_size));
    for (double n = first; n <= last; ++n) mask(hole.beam, static_cast<Eigen::Index>(n)) = 1;
  }
  return mask;
}

}  // namespace insonify
