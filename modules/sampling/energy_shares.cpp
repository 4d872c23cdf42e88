// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>

#include "core/parallel.hpp"
#include "sampling/energy_shares_internal.hpp"

namespace insonify {
namespace {

constexpr double most_positions = 65536, most_cells = 262144;  // cells of range or of u at most, and in all
constexpr std::size_t most_spanned = 256, sums_of_energy = 4;

}  // namespace

EnergyShares::EnergyShares(std::span<const ReceivedSurfel> surfels, const RangeGate& gate, const SampledCells& cells,
                           int threads)
    : width_(std::max(cells.width_of_shares(), 2 / most_positions)) {
  const double reach = gate.max_range - gate.min_range, positions = std::ceil(2 / width_);
  length_ = std::max(cells.range_resolution(), reach / std::min(most_positions, most_cells / positions));
  start_ = length_ * std::floor(gate.min_range / length_);
  size_ = length_ / cells.range_resolution() * width_ / cells.width_of_shares();
  positions_ = static_cast<std::size_t>(positions);
  ranges_ = static_cast<std::size_t>((gate.max_range - start_) / length_) + 1;
  for (std::uint8_t beyond = 0; beyond < energy_.size(); ++beyond) energy_[beyond] = sum_of(surfels, beyond, threads);
}

std::vector<double> EnergyShares::sum_of(std::span<const ReceivedSurfel> surfels, std::uint8_t beyond,
                                         int threads) const {
  const auto counts = [beyond](const ReceivedSurfel& s) { return s.beyond == beyond; };
  if (std::none_of(surfels.begin(), surfels.end(), counts)) return {};
  std::vector<std::vector<double>> sums(sums_of_energy);
  parallel_for(sums.size(), threads, [&](std::size_t block) {
    sums[block].assign(positions_ * ranges_, 0);
    for (std::size_t s = block * surfels.size() / sums.size(); s < (block + 1) * surfels.size() / sums.size(); ++s)
      if (counts(surfels[s])) add(surfels[s], sums[block]);
  });
  std::vector<double> all(positions_ * ranges_, 0);
  for (const std::vector<double>& sum : sums)
    std::transform(sum.begin(), sum.end(), all.begin(), all.begin(), std::plus<>());
  return all;
}

double EnergyShares::share(const ReceivedSurfel& surfel) const {
  const Cells cells = spanned(surfel);
  if (cells.number() > most_spanned) return HUGE_VAL;
  if (!(surfel.energy > 0)) return 0;
  const auto energy_around = [&](std::size_t cell) {
    double energy = 0;
    for (std::uint8_t beyond = 0; beyond < energy_.size(); ++beyond)
      if ((beyond & ~surfel.beyond) == 0 && !energy_[beyond].empty()) energy += energy_[beyond][cell];
    return energy;
  };
  double shares = 0;
  for (std::size_t u = cells.u.first; u <= cells.u.second; ++u)
    for (std::size_t k = cells.range.first; k <= cells.range.second; ++k)
      shares += surfel.energy / energy_around(u * ranges_ + k);
  return shares / static_cast<double>(cells.number()) * size_;  // (E127)
}

void EnergyShares::add(const ReceivedSurfel& surfel, std::vector<double>& energy) const {
  const Cells cells = spanned(surfel);
  if (cells.number() > most_spanned) return;
  const double each = surfel.energy / static_cast<double>(cells.number());
  for (std::size_t u = cells.u.first; u <= cells.u.second; ++u)
    for (std::size_t k = cells.range.first; k <= cells.range.second; ++k) energy[u * ranges_ + k] += each;
}

EnergyShares::Cells EnergyShares::spanned(const ReceivedSurfel& surfel) const {
  // The cells of which the middle is within `half` of a position, counted in cells; at least the one that it is in.
  const auto span = [](double position, double half, std::size_t number) {
    const double most = static_cast<double>(number - 1), reach = std::max(0.0, half - 0.5);
    return Span(std::clamp(position - reach, 0.0, most), std::clamp(position + reach, 0.0, most));
  };
  return {span((surfel.range - start_) / length_, surfel.half_depth / length_, ranges_),
          span((surfel.u + 1) / width_, surfel.half_u / width_, positions_)};
}

}  // namespace insonify
