#include "sampling/cast_rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
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
  double solid_angle = 0;  // [sr]
  std::uint32_t number = 0;
};

// What one block of beams found.
struct Catch {
  Scatterers scatterers;
  std::size_t missed = 0;
};

void append(const Scatterers& from, Scatterers& to) {
  const auto join = [](const auto& tail, auto& all) { all.insert(all.end(), tail.begin(), tail.end()); };
  join(from.range, to.range);
  join(from.azimuth, to.azimuth);
  join(from.elevation, to.elevation);
  join(from.cos_incidence, to.cos_incidence);
  join(from.projected_area, to.projected_area);
  join(from.material, to.material);
  join(from.id, to.id);
  join(from.surfel, to.surfel);
}

class RayCaster {
 public:
  RayCaster(const SceneCloud& scene, const std::vector<GatedSurfel>& surfels, const DirectionIndex& index,
            const RangeGate& gate, const SamplingOptions& options)
      : scene_(scene), surfels_(surfels), index_(index), gate_(gate), options_(options) {}

  void cast_beam(std::size_t beam, const BeamShare& share, Catch& caught) {
    const auto n = static_cast<std::size_t>(options_.rays_per_beam);
    const double shift = random_uniform(options_.seed, RandomStage::ray_jitter, {beam, ~0ull, 0})[0];
    const double width = share.max_azimuth - share.min_azimuth;
    const double step = (share.max_elevation - share.min_elevation) / static_cast<double>(n);
    for (std::size_t k = 0; k < n; ++k) {
      const double jitter = random_uniform(options_.seed, RandomStage::ray_jitter, {beam, k, 0})[0];
      const double across = shift + static_cast<double>(k) * golden;
      Ray ray;
      ray.direction.azimuth = std::remainder(share.min_azimuth + width * (across - std::floor(across)), 2 * pi);
      ray.direction.elevation = share.min_elevation + step * (static_cast<double>(k) + jitter);
      ray.solid_angle = std::cos(ray.direction.elevation) * width * step;
      ray.number = static_cast<std::uint32_t>(beam * n + k);
      cast(ray, caught);
    }
  }

 private:
  void cast(const Ray& ray, Catch& caught) {
    const Eigen::Vector3f u = unit_vector(ray.direction).cast<float>();
    candidates_.clear();
    index_.any(u, std::numeric_limits<float>::infinity(), scratch_, [&](std::uint32_t s) {
      candidates_.push_back(s);
      return false;
    });
    RayHit hit;
    switch (hit_surface(surfels_, u, options_.occlusion, candidates_, hit)) {
      case RayFate::missed:
        ++caught.missed;
        break;
      case RayFate::blocked:
        break;
      case RayFate::echoes:
        keep(ray, u, hit, caught.scatterers);
    }
  }

  void keep(const Ray& ray, const Eigen::Vector3f& direction, const RayHit& hit, Scatterers& out) const {
    const double range = hit.range;
    if (range < gate_.min_range || range > gate_.max_range) return;
    const GatedSurfel& s = surfels_[hit.surfel];
    out.range.push_back(range);
    out.azimuth.push_back(ray.direction.azimuth);
    out.elevation.push_back(ray.direction.elevation);
    out.cos_incidence.push_back(std::clamp(s.away.dot(direction), 0.0f, 1.0f));
    out.projected_area.push_back(static_cast<float>(range * range * ray.solid_angle));
    out.material.push_back(scene_.material[s.surfel]);
    out.id.push_back(std::uint64_t{scene_.id[s.surfel]} << 32 | ray.number);
    out.surfel.push_back(s.surfel);
  }

  const SceneCloud& scene_;
  const std::vector<GatedSurfel>& surfels_;
  const DirectionIndex& index_;
  const RangeGate& gate_;
  const SamplingOptions& options_;
  std::vector<std::uint32_t> candidates_;
  std::vector<Neighbour> scratch_;
};

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

CastResult cast_rays(const SceneCloud& scene, const std::vector<GatedSurfel>& surfels, const DirectionIndex& index,
                     const std::vector<BeamShare>& shares, const RangeGate& gate, const SamplingOptions& options) {
  constexpr std::size_t block = 4;
  std::vector<Catch> caught((shares.size() + block - 1) / block);
  parallel_blocks(shares.size(), block, options.threads, [&](std::size_t begin, std::size_t end) {
    RayCaster caster(scene, surfels, index, gate, options);
    for (std::size_t b = begin; b < end; ++b) caster.cast_beam(b, shares[b], caught[begin / block]);
  });
  CastResult result;
  for (const Catch& part : caught) {
    append(part.scatterers, result.scatterers);
    result.missed += part.missed;
  }
  result.met_surfels = count_different(result.scatterers.surfel);
  return result;
}

}  // namespace insonify
