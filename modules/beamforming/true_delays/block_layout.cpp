// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "beamforming/true_delays/true_delay_plan_internal.hpp"
#include "core/units.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
namespace {

// Phase of the curvature over a block's ranges: powers of time up to it fit single precision [rad].
constexpr double most_phase = 5;
constexpr double widest_band = 1.35;  // off the carrier, of it: up to there, blocks keep the tolerance
// Blocks are doubled so often at most; the last time only where the curvature has no more phase than this: where terms
// and powers are many, longer ones leave the caches.
constexpr std::size_t longest_level = 2;
constexpr double most_curvature = 2;
constexpr double left_of_doppler = 0.7;  // share of the tolerance for Doppler shifts between those of plans

/// Range at which the curvature moves the frequencies of the outermost elements by half of the band [m].
double moving_range(const SonarHead& head) {
  return length_of(head.array) * std::sqrt(head.pulse.centre_frequency / (8 * head.pulse.bandwidth));
}

/// Pulses that begin at three lengths of the array, or more of narrow bands.
double nearest_range(const SonarHead& head, const Medium& medium, const TrueDelaySizes& sizes) {
  // Curvature that changes with range moves the frequencies of the outermost elements: by 0.3 of the band at most. What
  // is of third order over a pulse is left out: measured at 0.01 of that part of the band times (reach / range)^2.
  // Where the band reaches so far below zero, the array is shorter than the rows between which it is interpolated.
  if (sizes.half_band > widest_band * head.pulse.centre_frequency) return head.gate.max_range + sizes.aperture;
  const double length = sizes.aperture, reach = 0.5 * medium.sound_speed * sizes.reach, moved = moving_range(head);
  // Between plans for shifts of both signs, what is of second order in the shift is left out: two of doppler_error^2.
  const double shifted =
      sizes.doppler.centre == 0
          ? 0
          : std::sqrt(doppler_error(head, sizes.doppler.most, 1) / std::sqrt(0.5 * left_of_doppler * sizes.tolerance));
  return std::max({3 * length, moved / std::sqrt(0.3), std::sqrt(moved * reach / std::sqrt(50 * sizes.tolerance)),
                   shifted}) +
         reach;
}

}  // namespace

CurvaturePhase::CurvaturePhase(const SonarHead& head, const Medium& medium, double near, double far) {
  const double length = length_of(head.array);
  all = pi * (head.pulse.centre_frequency + 0.6 * head.pulse.bandwidth) / medium.sound_speed * 0.25 * length * length /
        near;
  over_range = 0.5 * all * (1 - near / far);
}

double doppler_error(const SonarHead& head, double shift, double range) {
  if (!is_gaussian(head.pulse)) return 0;
  // (E191) The root mean square over a shaded array, measured.
  return 0.32 * std::abs(shift) / head.pulse.bandwidth * std::pow(moving_range(head) / range, 2);
}

BlockLayout::BlockLayout(const SonarHead& head, const Medium& medium, double tolerance, double widest,
                         DopplerSpan doppler) {
  const TrueDelaySizes any(head, medium, tolerance, widest, doppler, 1);
  const auto bins = static_cast<double>(head.gate.bins());
  const std::size_t ends = any.guard;
  guard = static_cast<double>(ends);
  const auto fits = [&](double range, std::size_t level) {
    const double far = range + static_cast<double>(2 * ends << level) * head.gate.bin_size;
    const CurvaturePhase phase(head, medium, range, far);
    return phase.over_range <= most_phase &&
           (level < longest_level || phase.all * any.widest * any.widest <= most_curvature);
  };
  double nearest = std::max(nearest_range(head, medium, any), 1e-3 * head.gate.bin_size);
  while (!fits(nearest, 0)) nearest *= 1.02;
  steady =
      left_of_doppler * tolerance / std::max(doppler_error(head, 1, std::max(nearest, head.gate.min_range)), 1e-300);
  double first = std::max(-guard, std::ceil((nearest - head.gate.min_range) / head.gate.bin_size));
  do {
    const double range = std::max(nearest, head.gate.min_range + first * head.gate.bin_size);
    const double allowed = range / head.gate.bin_size, wanted = bins + guard - first;
    const auto sizes_of = [&](std::size_t level) -> const TrueDelaySizes& {
      while (levels.size() <= level)
        levels.emplace_back(head, medium, tolerance, widest, doppler, 2 * ends << levels.size());
      return levels[level];
    };
    std::size_t level = 0;
    while (level < longest_level && static_cast<double>(sizes_of(level).block) < wanted &&
           static_cast<double>(2 * ends << (level + 1)) <= allowed && fits(range, level + 1))
      ++level;
    (void)sizes_of(level);
    const double last = first + static_cast<double>(levels[level].block);
    blocks.push_back({first, last, level});
    first = last;
  } while (first < bins + guard);
}

}  // namespace insonify
