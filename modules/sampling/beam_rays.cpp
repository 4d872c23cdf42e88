// SPDX-License-Identifier: BSD-3-Clause
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

std::vector<BeamCell> beam_cells(const BeamFan& fan, const Sector& sector) {
  // Columns of beams of one azimuth. Azimuths are unwrapped about the middle of the sector, so there is no jump at
  // +-pi.
  const double middle = (sector.min_azimuth + sector.max_azimuth) / 2;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t b = 0; b < fan.beams(); ++b) {
    order.emplace_back(middle + std::remainder(fan.azimuth[b] - middle, 2 * pi), b);
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

  // Cuts between columns are cones: in a grid those at the elevation of each row, else one for all elevations.
  for (auto& column : columns) std::sort(column.begin(), column.end());
  const bool grid = std::all_of(columns.begin(), columns.end(), [&](const auto& column) {
    return std::equal(column.begin(), column.end(), columns[0].begin(), columns[0].end(),
                      [](const auto& a, const auto& b) { return a.first == b.first; });
  });
  const auto [low, high] = std::minmax_element(fan.elevation.begin(), fan.elevation.end());
  const auto cut = [&, level = (*low + *high) / 2](std::size_t c, double elevation) {
    if (c == 0) return sector.min_azimuth;
    if (c == columns.size()) return sector.max_azimuth;
    const double a = (azimuth[c - 1] + azimuth[c]) / 2;
    return a + std::remainder(cone_azimuth(unit_vector({a, grid ? elevation : level})) - a, 2 * pi);
  };
  std::vector<BeamCell> shares(fan.beams());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::vector<double> elevation;
    for (const auto& [e, b] : columns[c]) elevation.push_back(e);
    const auto cuts = midpoints(elevation, sector.min_elevation, sector.max_elevation);
    for (std::size_t e = 0; e < elevation.size(); ++e)
      shares[columns[c][e].second] = {cut(c, elevation[e]), cut(c + 1, elevation[e]), cuts[e], cuts[e + 1]};
  }
  return shares;
}

std::vector<Ray> beam_rays(const std::vector<BeamCell>& shares, const SamplingOptions& options) {
  const auto n = static_cast<std::size_t>(options.rays_per_beam);
  std::vector<Ray> rays(shares.size() * n);
  parallel_for(shares.size(), options.threads, [&](std::size_t beam) {
    const BeamCell& share = shares[beam];
    const double shift = random_uniform(options.seed, RandomStage::ray_jitter, {beam, ~0ull, 0})[0];
    const double width = share.max_azimuth - share.min_azimuth;
    for (std::size_t k = 0; k < n; ++k) {
      const double jitter = random_uniform(options.seed, RandomStage::ray_jitter, {beam, k, 0})[0];
      const double across = shift + static_cast<double>(k) * golden;
      const double cone = share.min_azimuth + width * (across - std::floor(across));
      const auto [low, high] = turns_between(cone, share.min_elevation, share.max_elevation);
      const double step = (high - low) / static_cast<double>(n);
      Ray& ray = rays[beam * n + k];
      ray.direction = direction_in_cone(cone, low + step * (static_cast<double>(k) + jitter));
      ray.along = unit_vector(ray.direction).cast<float>();
      ray.solid_angle = std::abs(std::cos(cone)) * width * step;
    }
  });
  return rays;
}

}  // namespace insonify
