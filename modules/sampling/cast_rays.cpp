// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <limits>

#include "core/parallel.hpp"
#include "sampling/cast_rays_internal.hpp"
#include "sampling/direction_candidates_internal.hpp"
#include "sampling/direction_index_internal.hpp"
#include "sampling/hit_rule_internal.hpp"

namespace insonify {
namespace {

struct CastRay {
  RayOutcome outcome = RayOutcome::missed;
  RayHit hit;
};

std::vector<CastRay> cast_by_index(const GatedSurfels& surfels, const DirectionIndex& index,
                                   const std::vector<Ray>& rays, const SamplingOptions& options) {
  std::vector<CastRay> cast(rays.size());
  parallel_blocks(rays.size(), 256, options.threads, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> candidates;
    std::vector<Neighbour> scratch;
    for (std::size_t r = begin; r < end; ++r) {
      candidates.clear();
      index.any(rays[r].along, std::numeric_limits<float>::infinity(), scratch, [&](std::uint32_t s) {
        candidates.push_back(s);
        return false;
      });
      cast[r].outcome = hit_surface(surfels, rays[r].along, options.occlusion, candidates, cast[r].hit);
    }
  });
  return cast;
}

std::vector<CastRay> cast_by_raster(const GatedSurfels& surfels, const std::vector<Ray>& rays,
                                    const SamplingOptions& options) {
  std::vector<CubePoint> queries(rays.size());
  for (std::size_t r = 0; r < rays.size(); ++r) queries[r] = on_cube(rays[r].along);
  std::vector<CastRay> cast(rays.size());
  for_candidates(surfels, queries, options.threads, [&](std::uint32_t r, std::vector<std::uint32_t>& candidates) {
    cast[r].outcome = hit_surface(surfels, rays[r].along, options.occlusion, candidates, cast[r].hit);
  });
  return cast;
}

// Counts the missed rays that are surrounded by surfels within three footprints.
std::size_t count_holes(GatedSurfels surfels, const std::vector<Ray>& rays, const std::vector<CastRay>& cast,
                        int threads) {
  constexpr float footprints = 3;
  std::vector<std::uint32_t> missed;
  std::vector<CubePoint> queries;
  for (std::uint32_t r = 0; r < rays.size(); ++r)
    if (cast[r].outcome == RayOutcome::missed) {
      missed.push_back(r);
      queries.push_back(on_cube(rays[r].along));
    }
  if (missed.empty() || surfels.empty()) return 0;
  for (GatedSurfel& s : surfels) s.radius *= footprints;
  std::atomic<std::size_t> holes{0};
  for_candidates(surfels, queries, threads, [&](std::uint32_t q, std::vector<std::uint32_t>& candidates) {
    const Eigen::Vector3f& along = rays[missed[q]].along;
    keep_covering(along, surfels, candidates);
    if (is_surrounded(along, surfels, candidates)) ++holes;
  });
  return holes;
}

std::size_t count_different(std::vector<std::uint32_t> values) {
  std::sort(values.begin(), values.end());
  return static_cast<std::size_t>(std::unique(values.begin(), values.end()) - values.begin());
}

}  // namespace

CastResult cast_rays(const SceneCloud& scene, const GatedSurfels& surfels, Projection projection,
                     const std::vector<BeamCell>& shares, const RangeGate& gate, const SamplingOptions& options) {
  const std::vector<Ray> rays = beam_rays(shares, options);
  const std::vector<CastRay> cast =
      projection == Projection::raster
          ? cast_by_raster(surfels, rays, options)
          : cast_by_index(surfels, DirectionIndex(surfels, projection, 1, options.threads), rays, options);
  CastResult result;
  Scatterers& out = result.scatterers;
  for (std::size_t r = 0; r < rays.size(); ++r) {
    const RayHit& hit = cast[r].hit;
    const double range = hit.range;
    result.missed += cast[r].outcome == RayOutcome::missed;
    if (cast[r].outcome != RayOutcome::hit || range < gate.min_range || range > gate.max_range) continue;
    const GatedSurfel& s = surfels[hit.surfel];
    out.range.push_back(range);
    out.azimuth.push_back(rays[r].direction.azimuth);
    out.elevation.push_back(rays[r].direction.elevation);
    out.cos_incidence.push_back(std::clamp(s.away.dot(rays[r].along), 0.0f, 1.0f));
    out.projected_area.push_back(static_cast<float>(range * range * rays[r].solid_angle));
    out.material.push_back(scene.material[s.surfel]);
    out.id.push_back(scene.piece_id(s.surfel, r));
    out.surfel.push_back(s.surfel);
  }
  if (result.missed > 0) result.unknown = count_holes(surfels, rays, cast, options.threads);
  result.hit_surfels = count_different(out.surfel);
  return result;
}

}  // namespace insonify
