// SPDX-License-Identifier: BSD-3-Clause
// Parts of the band in which beams of a DisplayPlan hear grating lobes (E226).
#include <algorithm>
#include <cmath>
#include <vector>

#include "beamforming/display/display_plan_internal.hpp"
#include "beamforming/display/looks_loops_internal.hpp"
#include "beamforming/display/mean_of_pairs_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr double half_bands = 1.5;    // half-widths of the band on either side that a spectrum has nodes for
constexpr double least_alike = 1e-3;  // correlation of parts of the band from which on it counts
constexpr double steps_of_lobe = 4;   // steps between nodes of frequency
constexpr double most_of_steps = 64;

double sinc_square(double x) {
  if (x == 0) return 1;
  const double value = std::sin(pi * x) / (pi * x);
  return value * value;
}

/// Calls use(frequency, weight) for `steps` equal steps between the nodes of a spectrum.
template <typename Use>
void for_each_frequency(const std::vector<SpectrumNode>& spectrum, double steps, const Use& use) {
  const double apart = spectrum[1].frequency - spectrum[0].frequency;
  for (const SpectrumNode& node : spectrum)
    for (double k = 0.5; k < steps; ++k) use(node.frequency + (k / steps - 0.5) * apart, node.weight / steps);
}

}  // namespace

double DisplayPlan::farthest_of(const BeamFan& fan) const {
  double most = 0;
  for (const double u : beam_cosines(fan)) most = std::max(most, std::abs(u));
  return 1 + most;
}

double DisplayPlan::nearest_grating(const SonarHead& head) const {
  const double between = node_width * static_cast<double>(period), reach = main_lobe_reach * head.fan.beam_width;
  return (between - reach) / (1 + half_bands * head.pulse.bandwidth / head.pulse.centre_frequency);
}

void DisplayPlan::fill_gratings(const SonarHead& head) {
  const double width = 2 * node_width, nearest = nearest_grating(head), farthest = farthest_of(head.fan);
  if (!(nearest < farthest && nearest > main_lobe_reach * head.fan.beam_width)) return;
  gratings.first = static_cast<std::size_t>(nearest / width);
  const std::size_t count = static_cast<std::size_t>(farthest / width) - gratings.first + 1;
  gratings.count = kernels::row_length(count);

  // A lobe stands at the frequency (distance of lobes / distance - 1) over the carrier's. Parts are as wide as a lobe.
  const double between = node_width * static_cast<double>(period), elements = static_cast<double>(lag.size());
  const double high = half_bands * head.pulse.bandwidth / head.pulse.centre_frequency;
  const double low = std::max(-high, (between - main_lobe_reach * head.fan.beam_width) / farthest - 1);
  const auto parts = static_cast<std::size_t>(std::ceil((high - low) * farthest * elements / between));
  gratings.bands = std::min(kernels::row_length(parts), kernels::most_bands);
  const double part = (high - low) / static_cast<double>(gratings.bands);
  gratings.heard.assign(gratings.count * gratings.bands, 0);
  gratings.all.assign(gratings.count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const double distance = static_cast<double>(gratings.first + i) * width;
    for_each_frequency(band_, steps_of_lobe, [&](double frequency, double weight) {
      if (frequency < low) return;
      const auto q = std::min(static_cast<std::size_t>((frequency - low) / part), gratings.bands - 1);
      const auto heard = static_cast<float>(weight * response_at(distance * (1 + frequency)));
      gratings.heard[i * gratings.bands + q] += heard, gratings.all[i] += heard;
    });
  }
  gratings.reversed.assign(gratings.all.rbegin(), gratings.all.rend());
  // A cell resolves 1 / turns of the carrier frequency: cycles between echoes of its ends.
  correlate_parts(low, part, cell_length / pulse.metres_per_s() * head.pulse.centre_frequency);
}

void DisplayPlan::correlate_parts(double low, double part, double turns) {
  const double apart = band_[1].frequency - band_[0].frequency;
  const double steps = std::clamp(std::ceil(2 * apart * turns), 1.0, most_of_steps);
  for (std::size_t q = 0; q < gratings.bands; ++q) {
    const double middle = low + (static_cast<double>(q) + 0.5) * part;
    double alike = 0;
    for_each_frequency(band_, steps, [&](double frequency, double weight) {
      alike += weight * sinc_square((frequency - middle) * turns);
    });
    gratings.with_band.push_back(static_cast<float>(alike));
  }
  constexpr int pairs = 32;
  for (std::size_t d = 0; d < gratings.bands; ++d) {
    const double mean =
        mean_of_pairs(pairs, [&](double s) { return sinc_square((static_cast<double>(d) + s) * part * turns); });
    gratings.alike.push_back(mean > least_alike ? static_cast<float>(mean) : 0);
  }
  while (gratings.alike.size() > 1 && gratings.alike.back() == 0) gratings.alike.pop_back();
}

}  // namespace insonify
