#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "sampling/beam_rays_internal.hpp"

namespace insonify {
namespace {

constexpr double golden = 0.61803398874989485;
constexpr double one_column = 1e-9;  // beams closer than this in azimuth [rad] form one column

// Midpoints between neighbours of an ascending list, preceded by `low` and followed by `high`.
std::vector<double> midpoints(const std::vector<double>& values, double low, double high) {
  std::vector<double> cuts = {low};
  for (std::size_t i = 1; i < values.size(); ++i) cuts.push_back((values[i - 1] + values[i]) / 2);
  cuts.push_back(high);
  return cuts;
}

}  // namespace

std::vector<BeamShare> beam_shares(const BeamFan& fan, const Sector& sector) {
  // Columns of beams of one azimuth. Azimuths are unwrapped from the starboard edge of the sector, so there is no jump
  // at +-pi.
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

std::vector<Ray> beam_rays(const std::vector<BeamShare>& shares, const SamplingOptions& options) {
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

}  // namespace insonify
