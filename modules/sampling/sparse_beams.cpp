// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "sampling/list_where_internal.hpp"
#include "sampling/sparse_beams_internal.hpp"

namespace insonify {
namespace {

constexpr float enough = 4;  // surfels in a main lobe
constexpr std::size_t least_block = 2048, most_blocks = 32;

/// Beams of one elevation by direction cosine.
struct SortedRow {
  double elevation = 0;
  std::vector<std::pair<double, std::size_t>> beams;
};

std::vector<SortedRow> sorted_rows(const BeamFan& fan) {
  std::vector<SortedRow> sorted;
  for (const FanRow& row : fan_rows(fan)) {
    sorted.push_back({row.elevation, {}});
    for (const std::size_t b : row.beams)
      sorted.back().beams.emplace_back(std::cos(row.elevation) * std::sin(fan.azimuth[b]), b);
    std::sort(sorted.back().beams.begin(), sorted.back().beams.end());
  }
  return sorted;
}

}  // namespace

std::size_t count_sparse_beams(const GatedSurfels& surfels, const BeamFan& fan, const RangeGate& gate, int threads) {
  const double height = fan.row_width > 0 ? fan.row_width : fan.elevation_width;
  const auto lobe = static_cast<float>(fan.beam_width * height);
  const auto solid_angle = [](const GatedSurfel& s) {
    return s.spacing * s.spacing * s.plane_distance / (s.range * s.range * s.range);
  };
  const auto counts = [&](const GatedSurfel& s) { return s.facing && s.range >= gate.min_range; };
  const auto sparse = [&](const GatedSurfel& s) { return enough * solid_angle(s) > lobe; };
  if (count_where(surfels.size(), threads, [&](std::size_t i) { return counts(surfels[i]) && sparse(surfels[i]); }) ==
      0)
    return 0;

  // Solid angle of the surfels whose discs reach into each main lobe: of the sparse ones less that of the others.
  const std::vector<SortedRow> rows = sorted_rows(fan);
  const auto add = [&](const GatedSurfel& s, std::vector<double>& balance) {
    const double reach = s.radius / s.range, u = s.position.y() / s.range;
    const double elevation = std::asin(std::clamp(s.position.z() / s.range, -1.0F, 1.0F));
    const double signed_angle = sparse(s) ? solid_angle(s) : -solid_angle(s);
    for (const SortedRow& row : rows) {
      if (std::abs(row.elevation - elevation) > height / 2 + reach) continue;
      const double half = fan.beam_width / 2 + reach;
      auto at = std::lower_bound(row.beams.begin(), row.beams.end(), std::pair<double, std::size_t>(u - half, 0));
      for (; at != row.beams.end() && at->first <= u + half; ++at) balance[at->second] += signed_angle;
    }
  };
  // Sums of blocks, whose number does not depend on the threads.
  const std::size_t block = std::max(least_block, (surfels.size() + most_blocks - 1) / most_blocks);
  std::vector<std::vector<double>> sums((surfels.size() + block - 1) / block);
  parallel_blocks(surfels.size(), block, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<double>& balance = sums[begin / block];
    balance.assign(fan.beams(), 0);
    for (std::size_t i = begin; i < end; ++i)
      if (counts(surfels[i])) add(surfels[i], balance);
  });
  std::vector<double> balance(fan.beams(), 0);
  for (const auto& of_block : sums)
    for (std::size_t b = 0; b < balance.size(); ++b) balance[b] += of_block[b];
  return static_cast<std::size_t>(std::count_if(balance.begin(), balance.end(), [](double b) { return b > 0; }));
}

}  // namespace insonify
