// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "returns/find_contributors.hpp"

// Echoes sorted by their origin, for find_contributors.
namespace insonify {

/// The range axis as delays [s], and the half length of pulses. A pulse ends where it falls below floor_db, for Doppler
/// shifts up to `doppler` [Hz].
struct DelayBins {
  double start, step, half;
  std::size_t bins, length;  ///< length: largest number of bins that one pulse overlaps

  DelayBins(const SonarHead& head, const Medium& medium, double floor_db, double doppler);
  double at(std::size_t bin) const { return start + static_cast<double>(bin) * step; }
  double first(double delay) const { return std::max(0.0, std::ceil((delay - half - start) / step)); }
  double end(double delay) const {
    return std::min(static_cast<double>(bins), std::floor((delay + half - start) / step) + 1);
  }
  bool reaches(double delay) const { return end(delay) > first(delay); }
  /// Returns the first bin that a pulse with this delay overlaps, and one past the last.
  std::pair<std::size_t, std::size_t> reached(double delay) const {
    const auto low = static_cast<std::size_t>(first(delay));
    return {low, std::min(static_cast<std::size_t>(end(delay)), low + length)};
  }
};

/// The properties of one echo that find_contributors needs.
struct Arrival {
  double delay, u, v, power, doppler;
  std::uint32_t surfel;
  LegPair legs;
  std::uint32_t before = Contributors::none;

  auto key() const { return std::tuple(surfel, legs.out, legs.back, before != Contributors::none); }
};

/// The arrivals [first, last) of one contributor.
struct Group {
  std::uint32_t surfel;
  LegPair legs;
  float elevation;  ///< elevation of the strongest arrival [rad]
  std::size_t first, last;
  double u_low, u_high;
  std::uint32_t before = Contributors::none;  ///< value of the strongest arrival

  PathKind path() const {
    return before == Contributors::none ? static_cast<PathKind>(legs.bounces()) : PathKind::two_surfaces;
  }
};

/// Throws Error(argument) unless the echoes are complete, finite and from surfels of the scene.
void require_arrivals(const SceneCloud& scene, const SurfelEchoes& block, const char* who);

/// Returns all echoes that overlap a bin, grouped by contributor, by ascending surfel and legs.
std::vector<Arrival> sorted_arrivals(std::span<const SurfelEchoes> blocks, const DelayBins& axis);

std::vector<Group> groups_of(const std::vector<Arrival>& arrivals);

}  // namespace insonify
