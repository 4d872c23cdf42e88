// SPDX-License-Identifier: BSD-3-Clause
// Numbers of a DisplayPlan from which looks are counted (E182, E223), and the likeness of cells side by side (E224).
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "beamforming/display/display_plan_internal.hpp"
#include "beamforming/display/looks_loops_internal.hpp"
#include "beamforming/display/mean_of_pairs_internal.hpp"
#include "beamforming/numerics/receive_filter_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t least_parts_of_a_cell = 4;
constexpr double least_likeness = 0.02;  // correlation of cells side by side from which on it is drawn
constexpr double steps_per_pulse = 8;    // steps of a sum over pairs of ranges, for each length of a pulse
constexpr double most_steps = 8192;      // largest number of steps of such a sum

/// Returns the mean of f(r' - r) over all r of a cell and all r' of one that begins `ahead` [m] farther.
template <typename Function>
double mean_over_ranges(const DisplayPlan& plan, double ahead, const Function& f) {
  const double length = plan.cell_length, resolved = std::max(plan.pulse.half_length(), 1e-9);
  const auto steps = static_cast<int>(std::clamp(steps_per_pulse * length / resolved, 64.0, most_steps));
  return mean_of_pairs(steps, [&](double s) { return f(std::abs(ahead + s * length)); });
}

/// Returns the squared magnitudes of the correlation of samples of noise 0, 1, .. apart, fewer than `count`; those beyond
/// are 0.
std::vector<double> noise_correlation(const ReceiveFilter& filter, std::size_t count) {
  std::vector<std::complex<double>> taps(filter.real.begin(), filter.real.end());
  taps.insert(taps.end(), filter.complex.begin(), filter.complex.end());
  std::vector<double> square;
  for (std::size_t lag = 0; lag < std::min(count, taps.size()); ++lag) {
    std::complex<double> sum = 0;
    for (std::size_t k = 0; k + lag < taps.size(); ++k) sum += taps[k] * std::conj(taps[k + lag]);
    square.push_back(std::norm(sum));
  }
  return square;
}

}  // namespace

void DisplayPlan::fill_looks() {
  const double resolved = std::max(2 * pulse.half_length(), 1e-9);
  subranges = std::clamp(static_cast<std::size_t>(std::ceil(cell_length / resolved)), least_parts_of_a_cell,
                         kernels::most_subranges);
  const double length = cell_length / static_cast<double>(subranges);
  constexpr int steps = 32;
  for (std::size_t d = 0; d < subranges; ++d) {
    const double mean =
        mean_of_pairs(steps, [&](double s) { return pulse.correlation((static_cast<double>(d) + s) * length); });
    if (d > 0 && mean < 1e-4) break;
    looks.push_back(static_cast<float>(mean));
  }
}

void DisplayPlan::fill_noise_looks(const ReceiveFilter& filter, double sample_length) {
  // Means of samples are means of steps as wide as samples are apart: between lags their correlation is a straight line.
  const auto count = static_cast<std::size_t>(std::min(cell_length / sample_length, 1e6)) + 2;
  std::vector<double> noise = noise_correlation(filter, count);
  noise.resize(count + 1);
  const auto of_noise = [&](double distance) {
    const double position = distance / sample_length;
    const auto left = std::min(static_cast<std::size_t>(position), count - 1);
    return std::lerp(noise[left], noise[left + 1], position - static_cast<double>(left));
  };
  const auto of_ground = [&](double distance) { return pulse.correlation(distance); };
  const auto of_both = [&](double distance) { return std::sqrt(of_noise(distance) * of_ground(distance)); };
  const double ground = mean_over_ranges(*this, 0, of_ground);
  noise_with_ground = static_cast<float>(ground - mean_over_ranges(*this, 0, of_both));
  noise_alone = static_cast<float>(ground - mean_over_ranges(*this, 0, of_noise));  // (E223)
}

void DisplayPlan::fill_neighbours() {
  const auto of_ground = [&](double distance) { return pulse.correlation(distance); };
  const double likeness = mean_over_ranges(*this, cell_length, of_ground) / mean_over_ranges(*this, 0, of_ground);
  // The last field of a cell is one of so many looks. Ground shares as much through echoes of both cells.
  const double parts = static_cast<double>(field_parts);
  fields = FieldShares(likeness);
  if (likeness > least_likeness) noise_of_next = std::min(1.0, std::sqrt(likeness * parts));  // (E224)
}

}  // namespace insonify
