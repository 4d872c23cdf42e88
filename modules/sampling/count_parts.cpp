#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "sampling/count_parts_internal.hpp"

// Counts the parts of surfels:
//   1. by cells: so many that a cell of the surface holds scatterers_per_cell of them (E17);
//   2. by shares: a bin adds up what its beam hears from all directions of one range. Its relative error is the least
//      for a given number of parts if each surface has parts in proportion to what it gives, so none needs more (E127).
// Energies are added in the order of the scene, in a fixed number of sums: counts depend neither on threads nor on sorting.
namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr std::size_t counted_at_once = 512;
constexpr std::size_t max_scatterers = std::size_t{1} << 28, bytes_per_scatterer = 46;
constexpr double most_ranges = 65536;  // cells of range at most
constexpr std::size_t most_spanned = 256, sums_of_energy = 4;

/// A surfel as counting sees it.
struct Counted {
  double by_cells, energy, range, half_depth;
};

Counted measured(const SceneCloud& scene, const HeadFrame& head, std::uint32_t surfel, const SampledCells& cells,
                 const HeardEnergy& heard) {
  const Vector3d p = head.position(scene.point[surfel]), normal = head.direction(scene.normal[surfel].cast<double>());
  const double range = p.norm(), area = scene.area[surfel];
  const double cosine = std::min(1.0, std::abs(normal.dot(p)) / range);
  const double radius = std::sqrt(area / pi), sine = std::sqrt(1 - cosine * cosine);
  return {cells.parts(p, area, cosine), heard ? heard(p, cosine, area, scene.material[surfel]) : 0, range,
          radius * sine + 0.5 * radius * radius / range};
}

/// Energy that is received from each cell of range.
class RangeEnergies {
 public:
  RangeEnergies(std::span<const Counted> surfels, const RangeGate& gate, double range_resolution, int threads)
      : start_(gate.min_range),
        resolution_(range_resolution),
        length_(std::max(range_resolution, (gate.max_range - gate.min_range) / most_ranges)),
        energy_(static_cast<std::size_t>((gate.max_range - gate.min_range) / length_) + 1, 0.0) {
    // In a fixed number of parts, whatever the number of threads.
    std::vector<std::vector<double>> sums(surfels.empty() ? 0 : sums_of_energy);
    parallel_for(sums.size(), threads, [&](std::size_t part) {
      sums[part].assign(energy_.size(), 0);
      for (std::size_t s = part * surfels.size() / sums.size(); s < (part + 1) * surfels.size() / sums.size(); ++s)
        add(surfels[s], sums[part]);
    });
    for (const std::vector<double>& sum : sums)
      std::transform(sum.begin(), sum.end(), energy_.begin(), energy_.begin(), std::plus<>());
  }

  /// Sum of a surfel's shares over the ranges that it spans; without bound if they are very many.
  double share(const Counted& s) const {
    const auto [first, last] = span_of(s);
    if (last - first >= most_spanned) return HUGE_VAL;
    if (!(s.energy > 0)) return 0;
    double shares = 0;
    for (std::size_t k = first; k <= last; ++k) shares += s.energy / energy_[k];
    return shares / static_cast<double>(last - first + 1) * (length_ / resolution_);
  }

 private:
  void add(const Counted& s, std::vector<double>& energy) const {
    const auto [first, last] = span_of(s);
    if (last - first >= most_spanned) return;
    const double each = s.energy / static_cast<double>(last - first + 1);
    for (std::size_t k = first; k <= last; ++k) energy[k] += each;
  }
  std::pair<std::size_t, std::size_t> span_of(const Counted& s) const {
    const auto cell = [this](double range) {
      const double k = (range - start_) / length_;
      return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(energy_.size() - 1)));
    };
    return {cell(s.range - s.half_depth), cell(s.range + s.half_depth)};
  }

  double start_, resolution_, length_;
  std::vector<double> energy_;
};

}  // namespace

PartCounts count_parts(const SceneCloud& scene, const HeadFrame& head, std::span<const std::uint32_t> surfels,
                       const SampledCells& cells, const RangeGate& gate, const SamplingOptions& options) {
  const bool by_shares = options.heard && cells.scatterers_per_cell() > 0;
  UnsetVector<Counted> counted(surfels.size());
  parallel_blocks(surfels.size(), counted_at_once, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) counted[s] = measured(scene, head, surfels[s], cells, options.heard);
  });
  const std::span<const Counted> heard = by_shares ? counted : std::span<const Counted>();
  const RangeEnergies received(heard, gate, cells.range_resolution(), options.threads);

  PartCounts counts{std::vector<std::uint16_t>(surfels.size())};
  std::atomic<std::size_t> capped{0};
  parallel_blocks(surfels.size(), counted_at_once, options.threads, [&](std::size_t begin, std::size_t end) {
    std::size_t capped_here = 0;
    for (std::size_t s = begin; s < end; ++s) {
      double wanted = counted[s].by_cells;
      if (by_shares && wanted > 1) wanted = std::min(wanted, cells.parts_of_share(received.share(counted[s])));
      counts.parts[s] = static_cast<std::uint16_t>(std::ceil(std::clamp<double>(wanted, 1, most_parts)));
      capped_here += wanted > most_parts;
    }
    capped += capped_here;
  });
  counts.capped = capped;
  return counts;
}

std::vector<std::size_t> first_parts(std::span<const std::uint16_t> parts, double scatterers_per_cell) {
  std::vector<std::size_t> first(parts.size() + 1, 0);
  for (std::size_t s = 0; s < parts.size(); ++s) first[s + 1] = first[s] + parts[s];
  if (first.back() > max_scatterers)
    fail(ErrorKind::argument, "split_surfels: ", parts.size(), " surfels make ", first.back(), " scatterers (",
         first.back() * bytes_per_scatterer >> 30,
         " GiB), must be at most 2^28; lower scatterers_per_cell = ", scatterers_per_cell, ", or thin the scene");
  return first;
}

}  // namespace insonify
