// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/parallel.hpp"
#include "core/positions_by_group.hpp"
#include "core/radix_sort.hpp"
#include "core/uninitialized_vector.hpp"
#include "core/units.hpp"
#include "sampling/sort_by_place_internal.hpp"

namespace insonify {
namespace {

constexpr double bins_of_band = 64, most_bands = 1 << 19;  // a gate has at most 2^24 bins
constexpr int step_bits = 20;                              // of u
constexpr std::size_t few_keys = 128, keys_ahead = 16;     // that are sorted by comparing; loaded into the cache
constexpr std::size_t least_at_once = 8192;                // surfels that a thread counts and puts into bands

struct PlaceKey {
  double u;
  std::uint32_t at;  // in the given surfels, which ascend
};

bool is_before(const PlaceKey& a, const PlaceKey& b) { return std::tuple(a.u, a.at) < std::tuple(b.u, b.at); }

/// Number of the step of u that a key is on.
std::uint64_t step_of(const PlaceKey& key) {
  constexpr double steps = 1 << step_bits;
  return static_cast<std::uint64_t>(std::clamp((key.u + 1) * (0.5 * steps), 0.0, steps - 1));
}

/// Sorts the keys of a band, which ascend by index: by steps of u, then those of one step.
void sort_by_u(std::span<PlaceKey> keys) {
  if (keys.size() < few_keys) return std::sort(keys.begin(), keys.end(), is_before);
  std::vector<std::uint64_t> order(keys.size());
  for (std::size_t k = 0; k < keys.size(); ++k) order[k] = step_of(keys[k]) << 32 | k;
  radix_sort(order, 32, 32 + step_bits, [](std::uint64_t o) { return o; });
  const std::vector<PlaceKey> given(keys.begin(), keys.end());
  for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
    for (; end < keys.size() && order[end] >> 32 == order[begin] >> 32; ++end)
      keys[end] = given[static_cast<std::uint32_t>(order[end])];
    if (end - begin > 1) std::sort(&keys[begin], &keys[begin] + (end - begin), is_before);
  }
}

}  // namespace

PlacedSurfels sort_by_place(const SceneCloud& scene, const HeadFrame& head, const RangeGate& gate, SurfelOrder order,
                            std::span<const std::uint32_t> surfels, std::span<const std::uint16_t> pieces,
                            int threads) {
  // Blocks are so large that their numbers of all bands are no more than surfels or bands.
  const std::size_t count = surfels.size(),
                    at_once = std::max(least_at_once, gate.bins() / static_cast<std::size_t>(bins_of_band));
  UninitializedVector<SurfelBounds> bounds(count);
  UninitializedVector<std::uint32_t> band(count);
  ItemsOfBlocks in_band((count + at_once - 1) / at_once);
  parallel_blocks(count, at_once, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<std::size_t>& bands = in_band[begin / at_once];
    for (std::size_t s = begin; s < end; ++s) {
      const Eigen::Vector3d p = head.position_of(surfels[s]);
      const double r = std::max(p.norm(), 1e-6), reach = 1.001 * std::sqrt(scene.area[surfels[s]] / pi) + 1e-6 * r;
      band[s] = static_cast<std::uint32_t>(
          std::clamp((r - gate.min_range) / (bins_of_band * gate.bin_size), 0.0, most_bands));
      bounds[s] = {r, reach, p.y() / r, std::min(2.0, 2 * reach / r)};
      if (band[s] >= bands.size()) bands.resize(band[s] + std::size_t{1}, 0);
      ++bands[band[s]];
    }
  });
  // Each band by itself.
  std::size_t most = 0;
  for (const auto& bands : in_band) most = std::max(most, bands.size());
  for (auto& bands : in_band) bands.resize(most, 0);
  const std::vector<std::size_t> first = positions_by_group(in_band, most);
  UninitializedVector<PlaceKey> keys(count);
  parallel_blocks(count, at_once, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<std::size_t>& next = in_band[begin / at_once];
    for (std::size_t s = begin; s < end; ++s) keys[next[band[s]]++] = {bounds[s].u, static_cast<std::uint32_t>(s)};
  });
  PlacedSurfels sorted{std::vector<std::uint32_t>(count), std::vector<SurfelBounds>(count),
                       std::vector<std::uint16_t>(count)};
  parallel_for(first.size() - 1, threads, [&](std::size_t b) {
    if (order == SurfelOrder::range_and_u) sort_by_u(std::span(keys).subspan(first[b], first[b + 1] - first[b]));
    for (std::size_t k = first[b]; k < first[b + 1]; ++k) {
      if (k + keys_ahead < first[b + 1]) __builtin_prefetch(&bounds[keys[k + keys_ahead].at]);
      const std::uint32_t s = keys[k].at;
      sorted.surfel[k] = surfels[s], sorted.bounds[k] = bounds[s], sorted.pieces[k] = pieces[s];
    }
  });
  return sorted;
}

}  // namespace insonify
