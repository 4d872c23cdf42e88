// Cost model of the synthesis with true delays: nanoseconds of one core, fitted to oculus-m750d, em2040, aris-3000 and
// p900-45 at 1 to 20 m and tolerances of 1e-3 and 1e-4 on one machine, good to a factor of 1.5 there.
#include <algorithm>
#include <cmath>

#include "beamforming/true_delays/wideband_feed_internal.hpp"
#include "beamforming/true_delays/wideband_loops_internal.hpp"
#include "beamforming/true_delays/wideband_plan_internal.hpp"
#include "beamforming/true_delays/wideband_synthesizer.hpp"

namespace insonify {
namespace {

constexpr double per_grid_sample = 2.6;  // of each term of a block
constexpr double per_tap = 3.5, per_beam_sample = 2;
constexpr double per_place = 120, per_row = 1000, per_tap_made = 500;
constexpr double per_pulse = 30, per_pulse_sample = 3, per_own_sample = 3;
constexpr double out_of_cache = 4;  // for pulses on planes above 1 MiB
constexpr double per_exact_sample = 35, per_exact_pair = 90;

/// Terms of the bend whose phase spreads by so much over a block: those of the power series of an exponential.
double terms_of(double spread, double tolerance) {
  double part = 2, terms = 1;
  for (; part > tolerance && terms < 100; ++terms) part *= 0.25 * spread / terms;
  return terms;
}

}  // namespace

WidebandCost wideband_cost(const SonarHead& head, const Medium& medium, const SynthesisOptions& options, double widest,
                           std::span<const double> ranges) {
  const double tolerance = wideband_share * options.tolerance, c = medium.sound_speed;
  const WidebandLayout layout(head, medium, tolerance, widest);
  const WidebandStretches stretches = stretches_of(layout, head, medium);
  const auto elements = static_cast<double>(head.array.elements()), beams = static_cast<double>(head.fan.beams());

  WidebandCost cost;
  std::vector<double> echoes(stretches.size() + 1, 0);
  for (const double range : ranges) ++echoes[stretches.of(2 * range / c)];
  std::vector<bool> used(layout.levels.size(), false);
  double room = 0, kept = 0, nanoseconds = 0;
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    if (echoes[b + 1] == 0) continue;
    const auto& [first, last, level] = layout.blocks[b];
    const WidebandSizes& s = layout.levels[level];
    const double near = std::max(0.5 * c * (s.time_of(first) - s.reach), 0.5 * s.aperture),
                 far = 0.5 * c * (s.time_of(last) + s.reach);
    const BendPhase phase(head, medium, near, std::max(near, far));
    const double terms = terms_of(phase.all * s.widest * s.widest + 2 * phase.over_range, 0.4 * tolerance);
    const auto grid = static_cast<double>(s.grid), fine = static_cast<double>(s.fine),
               cycle = static_cast<double>(s.cycle), rows = static_cast<double>(s.rows());
    const double chunks = 2 * static_cast<double>(s.top_line()) / kernels::lines_at_once + 2,
                 taps = chunks * elements * static_cast<double>(s.taps);
    const double nodes = 14 + 1.4 * phase.all * s.widest * s.widest, powers = 3 + 2 * phase.over_range;
    const double filled = fine * static_cast<double>(s.block) / cycle, frequencies = 0.5 * terms;
    nanoseconds += terms * per_grid_sample * (filled + cycle) * grid + per_tap * taps + per_beam_sample * beams * cycle;
    nanoseconds += 28 * per_place * nodes * powers * (14 + 0.5 * nodes) + per_row * terms * rows;
    kept += terms * grid * (16 * powers + 64);
    room = std::max(room, 8 * (fine * grid + 32 * terms * grid + frequencies * rows * (fine + cycle)) +
                              64 * chunks * (rows + 0.5 * elements));
    if (used[level]) continue;
    used[level] = true;
    nanoseconds += per_tap_made * chunks * elements;
    kept += 32 * taps + 4500 * rows;
  }
  cost.bytes = room + kept;

  const WidebandSizes& any = layout.levels.back();
  const auto samples = std::floor(2 * any.reach / any.fine_step) + 1;
  const bool own = medium.absorption.a1 != 0 || medium.absorption.a2 != 0;
  const double slower = 8 * static_cast<double>(any.fine * any.grid) > 0x1p20 ? out_of_cache : 1;
  cost.seconds_per_echo = 1e-9 * (per_pulse + slower * samples * (per_pulse_sample + (own ? per_own_sample : 0)));
  if (echoes[0] > 0) {
    // Element by element, at four times the band; all of the near part of the gate.
    const double share = echoes[0] / static_cast<double>(ranges.size()),
                 bins = std::clamp((layout.nearest - head.gate.min_range) / head.gate.bin_size, 0.0,
                                   static_cast<double>(head.gate.bins()));
    cost.seconds_per_echo += 1e-9 * share * elements * per_exact_sample * (2 + 8 * any.reach * any.half_band);
    nanoseconds += per_exact_pair * elements * beams * bins;
  }
  cost.seconds = 1e-9 * nanoseconds;
  return cost;
}

}  // namespace insonify
