// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/uninitialized_vector.hpp"
#include "core/units.hpp"
#include "sampling/count_pieces_internal.hpp"
#include "sampling/energy_shares_internal.hpp"

// Counts the parts of surfels:
//   1. by cells: so many that a cell of the surface holds scatterers_per_cell of them (E17);
//   2. by shares: a bin adds up what its beam receives from one range. Its relative error is the least for a given number
//      of parts if each surface has parts in proportion to what it gives, so none needs more (E127).
namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr std::size_t counted_at_once = 512;
constexpr double least_range = 1e-6;  // [m]
constexpr double rounding = 1e-9;     // of a sum that others were added to, parts
constexpr std::size_t max_scatterers = std::size_t{1} << 28, bytes_per_scatterer = 46;

/// A surfel as the head sees it.
struct Seen {
  Vector3d position;
  double range, area, cosine, radius;

  Seen(const SceneCloud& scene, const HeadFrame& head, std::uint32_t surfel)
      : position(head.position_of(surfel)),
        range(std::max(position.norm(), least_range)),
        area(scene.area[surfel]),
        cosine(std::min(1.0, std::abs(head.normal_of(surfel).dot(position)) / range)),
        radius(std::sqrt(area / pi)) {}

  ReceivedSurfel received(double energy, std::uint8_t beyond) const {
    const double sine = std::sqrt(1 - cosine * cosine);
    return {energy, range, radius * sine + 0.5 * radius * radius / range, position.y() / range, radius / range, beyond};
  }
};

/// Parts of a surfel by cells, and the widths of these.
struct ByCells {
  double pieces;
  SampledCells::Widths widths;
};

}  // namespace

PieceCounts count_pieces(const SceneCloud& scene, const HeadFrame& head, std::span<const std::uint32_t> surfels,
                         const SampledCells& cells, const RangeGate& gate, const SamplingOptions& options) {
  const bool by_shares = options.energy && cells.scatterers_per_cell() > 0;
  const auto inner = options.inner_sector ? std::optional<SectorBounds>(*options.inner_sector) : std::nullopt;
  const auto beyond = [&inner](const Vector3d& p) -> std::uint8_t {
    return inner ? (inner->in_cones(p) ? 0 : 1) | (inner->in_elevations(p) ? 0 : 2) : 0;
  };
  UninitializedVector<ByCells> by_cells(surfels.size());
  UninitializedVector<ReceivedSurfel> received(by_shares ? surfels.size() : 0);
  parallel_blocks(surfels.size(), counted_at_once, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      const Seen seen(scene, head, surfels[s]);
      const SampledCells::Widths widths = cells.widths(seen.position, seen.radius);
      by_cells[s] = {cells.pieces(seen.range, seen.area, seen.cosine, widths), widths};
      if (by_shares)
        received[s] =
            seen.received(options.energy->of(seen.position, seen.cosine, seen.area, scene.material[surfels[s]]),
                          beyond(seen.position));
    }
  });
  std::optional<EnergyShares> shares;
  if (by_shares) shares.emplace(received, gate, cells, options.threads);

  PieceCounts counts{std::vector<std::uint16_t>(surfels.size())};
  std::atomic<std::size_t> capped{0};
  parallel_blocks(surfels.size(), counted_at_once, options.threads, [&](std::size_t begin, std::size_t end) {
    std::size_t capped_here = 0;
    for (std::size_t s = begin; s < end; ++s) {
      double wanted = by_cells[s].pieces;
      if (by_shares && wanted > 1)
        wanted = std::min(wanted, cells.pieces_of_share(shares->share(received[s]), by_cells[s].widths));
      counts.pieces[s] =
          static_cast<std::uint16_t>(std::ceil(std::clamp<double>(wanted, 1, most_subranges) - rounding));
      capped_here += wanted > most_subranges;
    }
    capped += capped_here;
  });
  counts.capped = capped;
  return counts;
}

std::vector<std::size_t> first_pieces(std::span<const std::uint16_t> pieces, double scatterers_per_cell) {
  std::vector<std::size_t> first(pieces.size() + 1, 0);
  for (std::size_t s = 0; s < pieces.size(); ++s) first[s + 1] = first[s] + pieces[s];
  if (first.back() > max_scatterers)
    fail(ErrorKind::argument, "split_surfels: ", pieces.size(), " surfels make ", first.back(), " scatterers (",
         first.back() * bytes_per_scatterer >> 30,
         " GiB), must be at most 2^28; lower scatterers_per_cell = ", scatterers_per_cell, ", or thin the scene");
  return first;
}

}  // namespace insonify
