#include "sampling/cast_rays.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <span>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "sampling/direction_index.hpp"
#include "sampling/direction_raster.hpp"
#include "sampling/hit_rule.hpp"

namespace insonify {
namespace {

constexpr double golden = 0.61803398874989485;
constexpr double one_column = 1e-9;  // beams closer than this in azimuth [rad] share it

// Cuts between neighbours of an ascending list, and its two ends.
std::vector<double> midpoints(const std::vector<double>& values, double low, double high) {
  std::vector<double> cuts = {low};
  for (std::size_t i = 1; i < values.size(); ++i) cuts.push_back((values[i - 1] + values[i]) / 2);
  cuts.push_back(high);
  return cuts;
}

struct Ray {
  Direction direction;
  Eigen::Vector3f along;
  double solid_angle = 0;  // [sr]
};

std::vector<Ray> make_rays(const std::vector<BeamShare>& shares, const SamplingOptions& options) {
  const auto n = static_cast<std::size_t>(options.rays_per_beam);
  std::vector<Ray> rays(shares.size() * n);
  parallel_for(shares.size(), options.threads, [&](std::size_t beam) {
    const BeamShare& share = shares[beam];
    const double shift = random_uniform(options.seed, RandomStage::ray_jitter, {beam, ~0ull, 0})[0];
    const double width = share.max_azimuth - share.min_azimuth;
    const double step = (share.max_elevation - share.min_elevation) / static_cast<double>(n);
    for (std::size_t k = 0; k < n; ++k) {
      const double jitter = random_uniform(options.seed, RandomStage::ray_jitter, {beam, k, 0})[0];
      const double across = shift + static_cast<double>(k) * golden;
      Ray& ray = rays[beam * n + k];
      ray.direction.azimuth = std::remainder(share.min_azimuth + width * (across - std::floor(across)), 2 * pi);
      ray.direction.elevation = share.min_elevation + step * (static_cast<double>(k) + jitter);
      ray.along = unit_vector(ray.direction).cast<float>();
      ray.solid_angle = std::cos(ray.direction.elevation) * width * step;
    }
  });
  return rays;
}

// What became of one ray.
struct Landing {
  RayFate fate = RayFate::missed;
  RayHit hit;
};

std::vector<Landing> land_by_index(const std::vector<GatedSurfel>& surfels, const DirectionIndex& index,
                                   const std::vector<Ray>& rays, const SamplingOptions& options) {
  std::vector<Landing> landings(rays.size());
  parallel_blocks(rays.size(), 256, options.threads, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> candidates;
    std::vector<Neighbour> scratch;
    for (std::size_t r = begin; r < end; ++r) {
      candidates.clear();
      index.any(rays[r].along, std::numeric_limits<float>::infinity(), scratch, [&](std::uint32_t s) {
        candidates.push_back(s);
        return false;
      });
      landings[r].fate = hit_surface(surfels, rays[r].along, options.occlusion, candidates, landings[r].hit);
    }
  });
  return landings;
}

// For each query the surfels whose cone may hold it: calls use(query, candidates), from several threads.
template <typename Use>
void for_candidates(const std::vector<GatedSurfel>& surfels, std::span<const CubePoint> queries, int threads,
                    const Use& use) {
  const DirectionRaster raster(surfels, queries, Footprint::cone, threads);
  parallel_for(raster.tiles(), threads, [&](std::size_t t) {
    const DirectionTile tile = raster.tile(t);
    if (tile.queries.empty()) return;
    CellLists<std::uint32_t> cells;
    for (std::uint32_t k = 0; k < tile.queries.size(); ++k) cells.add(k, tile.cell_of(queries[tile.queries[k]]));
    std::vector<std::vector<std::uint32_t>> candidates(tile.queries.size(), raster.wide());
    for (const TileBox& box : tile.boxes)
      cells.for_each(box, [&](std::uint32_t k) { candidates[k].push_back(box.surfel); });
    for (std::size_t k = 0; k < tile.queries.size(); ++k) use(tile.queries[k], candidates[k]);
  });
}

std::vector<Landing> land_by_raster(const std::vector<GatedSurfel>& surfels, const std::vector<Ray>& rays,
                                    const SamplingOptions& options) {
  std::vector<CubePoint> queries(rays.size());
  for (std::size_t r = 0; r < rays.size(); ++r) queries[r] = on_cube(rays[r].along);
  std::vector<Landing> landings(rays.size());
  for_candidates(surfels, queries, options.threads, [&](std::uint32_t r, std::vector<std::uint32_t>& candidates) {
    landings[r].fate = hit_surface(surfels, rays[r].along, options.occlusion, candidates, landings[r].hit);
  });
  return landings;
}

// Rays that met nothing though surfels stand within three footprints on all sides of them.
std::size_t count_holes(std::vector<GatedSurfel> surfels, const std::vector<Ray>& rays,
                        const std::vector<Landing>& landings, int threads) {
  constexpr float reach = 3;
  std::vector<std::uint32_t> missed;
  std::vector<CubePoint> queries;
  for (std::uint32_t r = 0; r < rays.size(); ++r)
    if (landings[r].fate == RayFate::missed) {
      missed.push_back(r);
      queries.push_back(on_cube(rays[r].along));
    }
  if (missed.empty() || surfels.empty()) return 0;
  for (GatedSurfel& s : surfels) s.radius *= reach;
  std::atomic<std::size_t> holes{0};
  for_candidates(surfels, queries, threads, [&](std::uint32_t q, std::vector<std::uint32_t>& candidates) {
    const Eigen::Vector3f& along = rays[missed[q]].along;
    keep_footprints_of(along, surfels, candidates);
    if (is_surrounded(along, surfels, candidates)) ++holes;
  });
  return holes;
}

std::size_t count_different(std::vector<std::uint32_t> values) {
  std::sort(values.begin(), values.end());
  return static_cast<std::size_t>(std::unique(values.begin(), values.end()) - values.begin());
}

}  // namespace

std::vector<BeamShare> beam_shares(const BeamFan& fan, const Sector& sector) {
  // Columns: beams of one azimuth, measured from the sector's starboard edge, so that +-pi is no seam.
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t b = 0; b < fan.beams(); ++b) {
    const double from_edge = std::fmod(fan.azimuth[b] - sector.min_azimuth + 4 * pi, 2 * pi);
    order.emplace_back(sector.min_azimuth + from_edge, b);
  }
  std::sort(order.begin(), order.end());
  std::vector<double> azimuth;
  std::vector<std::vector<std::pair<double, std::size_t>>> columns;
  for (const auto& [a, b] : order) {
    if (azimuth.empty() || a - azimuth.back() > one_column) {
      azimuth.push_back(a);
      columns.emplace_back();
    }
    columns.back().emplace_back(fan.elevation[b], b);
  }

  const std::vector<double> azimuth_cuts = midpoints(azimuth, sector.min_azimuth, sector.max_azimuth);
  std::vector<BeamShare> shares(fan.beams());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::sort(columns[c].begin(), columns[c].end());
    std::vector<double> elevation;
    for (const auto& [e, b] : columns[c]) elevation.push_back(e);
    const auto cuts = midpoints(elevation, sector.min_elevation, sector.max_elevation);
    for (std::size_t e = 0; e < elevation.size(); ++e)
      shares[columns[c][e].second] = {azimuth_cuts[c], azimuth_cuts[c + 1], cuts[e], cuts[e + 1]};
  }
  return shares;
}

CastResult cast_rays(const SceneCloud& scene, const std::vector<GatedSurfel>& surfels, Projection projection,
                     const std::vector<BeamShare>& shares, const RangeGate& gate, const SamplingOptions& options) {
  const std::vector<Ray> rays = make_rays(shares, options);
  const std::vector<Landing> landings =
      projection == Projection::raster
          ? land_by_raster(surfels, rays, options)
          : land_by_index(surfels, DirectionIndex(surfels, projection, options.threads), rays, options);
  CastResult result;
  Scatterers& out = result.scatterers;
  for (std::size_t r = 0; r < rays.size(); ++r) {
    const RayHit& hit = landings[r].hit;
    const double range = hit.range;
    result.missed += landings[r].fate == RayFate::missed;
    if (landings[r].fate != RayFate::echoes || range < gate.min_range || range > gate.max_range) continue;
    const GatedSurfel& s = surfels[hit.surfel];
    out.range.push_back(range);
    out.azimuth.push_back(rays[r].direction.azimuth);
    out.elevation.push_back(rays[r].direction.elevation);
    out.cos_incidence.push_back(std::clamp(s.away.dot(rays[r].along), 0.0f, 1.0f));
    out.projected_area.push_back(static_cast<float>(range * range * rays[r].solid_angle));
    out.material.push_back(scene.material[s.surfel]);
    out.id.push_back(std::uint64_t{scene.id[s.surfel]} << 32 | r);
    out.surfel.push_back(s.surfel);
  }
  if (result.missed > 0) result.unknown = count_holes(surfels, rays, landings, options.threads);
  result.met_surfels = count_different(out.surfel);
  return result;
}

}  // namespace insonify
