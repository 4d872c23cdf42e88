// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>

#include "beamforming/display/display_plan_internal.hpp"
#include "beamforming/numerics/receive_filter_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t nodes_per_element = 4;
constexpr std::size_t nodes_between = 4;    // nodes to either side of a beam, from which its level is interpolated
constexpr std::size_t nodes_fading = 16;    // nodes beyond the farthest that a beam hears
constexpr std::size_t blocks_of_range = 4;  // with kernels of their own, where absorption changes the spectrum
constexpr double least_beside = 1e-12;
constexpr double least_spread = 1e-3;  // energy heard in other cells from which on it counts; an echo in a main lobe: 1

/// A period of fields has four samples per element, one of powers two for each lag, to either side.
const SampleKernel<4>& of_fields() {
  static const SampleKernel<4> made(4);
  return made;
}
const SampleKernel<8>& of_powers() {
  static const SampleKernel<8> made(2);
  return made;
}
/// Mean patterns reach beyond the lags of the centre frequency as far as bands are wide.
const SampleKernel<8>& of_means() {
  static const SampleKernel<8> made(1.25);
  return made;
}

double sinc(double x) { return x == 0 ? 1 : std::sin(pi * x) / (pi * x); }

std::size_t period_of(const SonarHead& head) { return fft_length(nodes_per_element * head.array.elements()); }

double node_width_of(const SonarHead& head, double wavelength) {
  return wavelength / (head.array.spacing * static_cast<double>(period_of(head)));
}

/// Parts of an echo's energy that a beam hears in the cell of the echo, in the next and beyond it, on each side, by nodes
/// apart (E188): each element hears it at its own range. Shorter ways than the pulse is long are part of the pulse.
using RangeSpread = std::array<std::vector<double>, 3>;
RangeSpread spread_of(const LineArray& array, const DisplayPlan& plan) {
  RangeSpread spread;
  for (auto& part : spread) part.assign(plan.all_length / 2, 0);
  const std::size_t count = array.elements();
  const double squares = std::inner_product(array.shading.begin(), array.shading.end(), array.shading.begin(), 0.0);
  for (std::size_t k = 0; k < spread[0].size(); ++k)
    for (std::size_t m = 0; m < count; ++m) {
      const double part = array.shading[m] * array.shading[m] / squares;
      const double way = 0.5 * array.spacing * element_position(m, count) * static_cast<double>(k) * plan.node_width;
      const double cells = (std::hypot(way, plan.pulse.deviation()) - plan.pulse.deviation()) / plan.cell_length;
      const double beyond = std::min(std::max(0.0, cells - 1), 1.0);
      spread[0][k] += part * std::max(0.0, 1 - cells);
      spread[1][k] += part * 0.5 * (std::min(cells, 1.0) - beyond);
      spread[2][k] += part * 0.5 * beyond;
    }
  return spread;
}

double wavelength_of(const SonarHead& head, const Medium& medium) {
  return medium.sound_speed / head.pulse.centre_frequency;
}

}  // namespace

DisplayPlan::DisplayPlan(const SonarHead& head, const Medium& medium, double sample_length)
    : nodes(static_cast<std::size_t>(std::ceil(2 / node_width_of(head, wavelength_of(head, medium))))),
      period(period_of(head)),
      broad(nodes / 2 + 1),
      node_width(node_width_of(head, wavelength_of(head, medium))),
      nodes_per_u(1 / node_width),
      beam_width(head.fan.beam_width),
      all_length(fft_length(2 * (nodes_apart(head.fan) + nodes_fading))),
      half_positions(head.array.elements() % 2 == 0),
      response(head.array, wavelength_of(head, medium)),
      pulse(head.pulse, medium, head.gate),
      edges(pulse.deviation(), head.gate.min_range, sample_length),
      cell_length(head.gate.bin_size),
      first_range(head.gate.min_range),
      cells(head.gate.bins()),
      to_elements({period, 1, 1, 0, false}, FFTW_FORWARD),
      to_period({period, 1, 1, 0, false}, FFTW_BACKWARD),
      to_all({all_length, 1, 1, 0, false}, FFTW_FORWARD),
      from_all({all_length, 1, 1, 0, false}, FFTW_BACKWARD),
      field_to_elements({period, 1, 1, 0, false}, FFTW_FORWARD),
      elements_to_field({period, 1, 1, 0, false}, FFTW_BACKWARD) {
  cycles_per_metre = 2 / wavelength_of(head, medium);
  fill_elements(head);
  first_element = (period - head.array.elements() / 2) % period;
  if (half_positions)
    for (std::size_t i = 0; i < nodes; ++i)
      turn.emplace_back(std::polar(1.0, -pi * (static_cast<double>(i) + 0.5) / static_cast<double>(period)));
  fill_kernels(head, medium);
  fill_lobe(head);
  fill_looks();
  fill_gratings(head);
  const double step = sample_length > 0 ? sample_length : default_bin_size(head.pulse, medium.sound_speed);
  fill_noise_looks(ReceiveFilter(head.pulse, 2 * step / medium.sound_speed), step);
  fill_neighbours();
}

void DisplayPlan::fill_elements(const SonarHead& head) {
  const auto n = static_cast<double>(head.array.elements()), in_period = static_cast<double>(period);
  const std::vector<double>& w = head.array.shading;
  const std::vector<double> pairs = lag_sums(head.array);
  for (std::size_t m = 0; m < w.size(); ++m) {
    const double place = static_cast<double>(m), frequency = (place - static_cast<double>(w.size() / 2)) / in_period;
    element_weight.push_back(static_cast<float>(w[m] / n / of_fields().transform(frequency)));
    lag.push_back(pairs[m] / (n * n));  // (E65)
    lag_weight.push_back(lag[m] / of_powers().transform(place / in_period));
    shared_weight.push_back(static_cast<float>(lag[m] / of_fields().transform(place / in_period)));
  }
}

BeamPositions DisplayPlan::positions_of(const BeamFan& fan) const {
  BeamPositions at;
  at.u_beam = beam_cosines(fan);
  for (const double u : at.u_beam) {
    const double node = (u + 1) / node_width - 0.5;  // centres of nodes are whole numbers
    at.in_all.push_back(of_means().at(node + 1));
    const double turns = node / static_cast<double>(period), within = turns - std::floor(turns);
    at.in_field.push_back(of_fields().at<float>(within * static_cast<double>(period)));
    at.in_power.push_back(of_powers().at(within * static_cast<double>(period)));
    at.broad_of.push_back(std::clamp(0.5 * (node - 0.5), 0.0, static_cast<double>(broad - 1)) / 2);
  }
  // Every other broad node: they stand as near as the array resolves, and looks between them are interpolated.
  const auto [least, most] = std::minmax_element(at.broad_of.begin(), at.broad_of.end());
  const auto begin = static_cast<std::size_t>(*least), end = static_cast<std::size_t>(*most) + 1;
  for (std::size_t k = begin; k <= end; ++k) at.broad_used.push_back(std::min(2 * k, broad - 1));
  for (double& position : at.broad_of) position -= static_cast<double>(begin);

  at.beam_near.assign(nodes, -1);
  const double reach = main_lobe_reach * fan.beam_width;
  std::vector<double> nearest(nodes, reach);
  for (std::size_t b = 0; b < at.u_beam.size(); ++b) {
    const std::size_t first = node_of(at.u_beam[b] - reach), last = node_of(at.u_beam[b] + reach);
    for (std::size_t i = first; i <= last; ++i) {
      const double away = std::abs((static_cast<double>(i) + 0.5) * node_width - 1 - at.u_beam[b]);
      if (away < nearest[i]) nearest[i] = away, at.beam_near[i] = static_cast<std::int32_t>(b);
    }
  }
  return at;
}

std::size_t DisplayPlan::nodes_apart(const BeamFan& fan) const {
  return std::min(nodes, static_cast<std::size_t>(std::ceil(farthest_of(fan) / node_width)));
}

double DisplayPlan::response_at(double offset) const {
  const double lobes = node_width * static_cast<double>(period);
  return response.intensity(std::min(2.0, std::abs(offset - lobes * std::nearbyint(offset / lobes))));
}

void DisplayPlan::fill_kernels(const SonarHead& head, const Medium& medium) {
  const double fc = head.pulse.centre_frequency;
  // Steps of frequency in which no side lobe within u of -1 to 1 moves by more than a fraction of its width.
  const auto steps = static_cast<std::size_t>(
      std::ceil(3 * head.pulse.bandwidth / fc * static_cast<double>(nodes) / nodes_per_element * 4));
  const std::size_t count = std::clamp<std::size_t>(steps, 9, 401);
  const Absorption& a = medium.absorption;
  const std::size_t blocks = a.a1 != 0 || a.a2 != 0 ? std::min(blocks_of_range, cells) : 1;
  const RangeSpread spread = spread_of(head.array, *this);
  const std::size_t farthest = nodes_apart(head.fan);
  bool spreads = false;
  const double reach = main_lobe_reach * head.fan.beam_width, grating = nearest_grating(head);
  double outside = 0, positions = 0;
  for (std::size_t block = 0; block < blocks; ++block) {
    const double middle = (static_cast<double>(block) + 0.5) * static_cast<double>(cells) / static_cast<double>(blocks);
    const auto spectrum = pulse.spectrum(first_range + middle * cell_length, count);
    if (block == blocks / 2)
      for (const SpectrumNode& node : spectrum) band_.push_back({node.frequency / fc, node.weight});
    std::vector<double> of_band(all_length / 2, 0);
    for (std::size_t k = 0; k < of_band.size(); ++k) {
      for (const SpectrumNode& node : spectrum)
        of_band[k] += node.weight * response_at(static_cast<double>(k) * node_width * (1 + node.frequency / fc));
      const double distance = static_cast<double>(k) * node_width;
      if (block == 0 && k < nodes && distance > reach && (distance < grating || grating < reach))
        outside += of_band[k], positions += 1;
    }
    for (std::size_t k = 0; block == 0 && k <= farthest; ++k)
      spreads = spreads || of_band[k] * (1 - spread[0][k]) > least_spread;
    kernel.push_back(
        kernel_from(of_band, spreads ? spread[0] : std::vector<double>(of_band.size(), 1), farthest));  // (E181)
    if (!spreads) continue;
    for (std::size_t k = 0; k < 2; ++k)
      kernel_beside[k].push_back(kernel_from(of_band, spread[k + 1], farthest));  // (E188)
  }
  beside_lobe = positions > 0 ? std::max(outside / positions, least_beside) : least_beside;
}

std::vector<double> DisplayPlan::kernel_from(const std::vector<double>& pattern, const std::vector<double>& share,
                                             std::size_t farthest) const {
  std::vector<std::complex<double>> of_band(all_length, 0), transformed(all_length);
  // Beyond what beams hear, the pattern fades out: an end of it would ring as far as the beams.
  const double first = static_cast<double>(farthest + nodes_between),
               fading = static_cast<double>(all_length / 2) - first;
  for (std::size_t k = 0; k < pattern.size(); ++k) {
    const double way = std::max(0.0, static_cast<double>(k) - first) / fading;
    of_band[k] = pattern[k] * share[k] * std::pow(std::cos(0.5 * pi * way), 2);
    if (k > 0) of_band[all_length - k] = of_band[k];
  }
  to_all.run(of_band.data(), transformed.data());
  std::vector<double> made(all_length);
  for (std::size_t q = 0; q < all_length; ++q) {
    const double cycles = static_cast<double>(std::min(q, all_length - q)) / static_cast<double>(all_length);
    if (cycles > of_means().highest()) continue;  // no lag of the array is so long
    made[q] = transformed[q].real() / static_cast<double>(all_length) / std::pow(sinc(cycles), 2) /
              of_means().transform(cycles);
  }
  return made;
}

void DisplayPlan::fill_lobe(const SonarHead& head) {
  const double reach = main_lobe_reach * head.fan.beam_width;
  for (std::size_t k = 0; k == 0 || 2 * static_cast<double>(k) * node_width < reach; ++k)
    lobe.push_back(static_cast<float>(response_at(2 * static_cast<double>(k) * node_width)));
}

}  // namespace insonify
