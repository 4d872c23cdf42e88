// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "beamforming/gridded/gridding_plan_internal.hpp"
#include "beamforming/numerics/fft_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "core/units.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
template <typename Real>
GriddingPlan<Real>::GriddingPlan(const SonarHead& head_in, const Medium& medium_in, double tolerance,
                                 KernelTolerance kernels)
    : head(head_in),
      medium(medium_in),
      axis(head.gate, medium.sound_speed),
      cut(pulse_cut(tolerance)),
      shapes(head.pulse, medium),
      kernel(kernels.u),
      grid(fft_length(std::max(2 * head.array.elements(), 2 * kernel.width()))),
      stride(grid + 2 * grid_pad),
      tile_bins(grid <= 2048 ? 64 : 32),
      grid_row(tile_bins + 8),
      cycles_per_u(head.array.spacing * head.pulse.centre_frequency / medium.sound_speed),
      element_offset(head.array.elements() % 2 == 0 ? 0.5 : 0.0),
      columns(kernel.pieces<Real>(0.1 * kernels.u)),
      fan(fan_rows(head.fan)) {
  plan_time(tolerance);
  plan_elements();
  plan_beams();
  if (head.column) column.emplace(head, medium, fan, kernels.v);
  choice.single_precision = sizeof(Real) == 4;
  choice.kernel_width = kernel.width();
  choice.grid = grid;
  choice.bytes_per_thread = static_cast<double>((2 * tile_rows * stride + 2 * grid_row * grid) * sizeof(Real));
}

template <typename Real>
void GriddingPlan<Real>::plan_time(double tolerance) {
  const PulseReach sent(head.pulse, medium.absorption, medium.sound_speed, false, cut);
  const bool sweep = !is_gaussian(head.pulse);
  // The centre of a sweep is a boundary between two pieces.
  half = sweep ? std::ceil(sent.half / axis.step) * axis.step : sent.half;
  choice.pulse_samples = static_cast<std::size_t>(std::floor(2 * half / axis.step + 1e-9)) + (sweep ? 0 : 1);
  if (!sweep) {
    // Echoes from beyond the axis, by less than four pulses, are the longest.
    longest_half = sent.at(axis.start + static_cast<double>(axis.bins) * axis.step + 4 * sent.half);
    longest_rows = static_cast<std::size_t>(std::floor(2 * longest_half / axis.step + 1e-9)) + 1;
    margin = longest_rows - 1;
  }
  tile_rows = tile_bins + 2 * margin;
  const EchoEnvelope envelope = echo_envelope(head.pulse, {}, 0);
  for (std::size_t k = 0; k < choice.pulse_samples; ++k)
    pulse_energy += std::norm(envelope.at((static_cast<double>(k) + 0.5) * axis.step - half));
  if (!sweep || medium.absorption.a1 != 0 || medium.absorption.a2 != 0) return;
  // The ends of a sweep are discontinuous, which polynomials cannot follow: their pieces are constant, and the
  // remainder is added echo by echo.
  sweep_ends = half > kind_of(head.pulse).end(head.pulse) - axis.step;
  const double first = -half / axis.step, last_piece = -first - 1;
  const auto value = [&](double x) {
    return envelope.at((sweep_ends ? std::clamp(x, first + 1, last_piece) : x) * axis.step);
  };
  const double error = 0.1 * tolerance / std::sqrt(static_cast<double>(choice.pulse_samples));
  sweep_re = PolynomialPieces<Real>::fit([&](double x) { return value(x).real(); }, first, choice.pulse_samples, error);
  sweep_im = PolynomialPieces<Real>::fit([&](double x) { return value(x).imag(); }, first, choice.pulse_samples, error);
}

template <typename Real>
PulseReach GriddingPlan<Real>::reach(bool moving) const {
  PulseReach reach(head.pulse, medium.absorption, medium.sound_speed, moving, cut);
  if (sweep_re.pieces > 0 && !moving) reach.half = half;
  return reach;
}

template <typename Real>
void GriddingPlan<Real>::plan_elements() {
  const std::size_t n = head.array.elements();
  const auto steps = static_cast<double>(grid);
  element.assign(grid, Complex(0));
  // Transforms have the sign of exp(2 pi i place cycles): places are counted from port.
  for (std::size_t m = 0; m < n; ++m) {
    const double position = element_position(m, n), kernel_transform = kernel.transform(position / steps);
    const auto frequency = static_cast<std::ptrdiff_t>(std::floor(position));
    element[static_cast<std::size_t>(frequency < 0 ? frequency + static_cast<std::ptrdiff_t>(grid) : frequency)] =
        static_cast<Real>(head.array.shading[n - 1 - m] /
                          (static_cast<double>(n) * kernel_transform * kernel_transform));
  }
  offset_phase.resize(grid);
  for (std::size_t j = 0; j < grid; ++j)
    offset_phase[j] = Complex(std::polar(1.0, 2 * pi * element_offset * static_cast<double>(j) / steps));
}

template <typename Real>
void GriddingPlan<Real>::plan_beams() {
  const std::size_t width = kernel.width();
  for (const double u : beam_cosines(head.fan)) {
    const Position position = position_of(u);
    const double low = position.step - 0.5 * static_cast<double>(width), first = std::ceil(low);
    for (std::size_t k = 0; k < width; ++k) {
      const double j = first + static_cast<double>(k), wraps = std::floor(j / static_cast<double>(grid));
      const double sign = wraps != 0 && element_offset != 0 ? -position.sign : position.sign;
      beam_weight.push_back(static_cast<Real>(sign * kernel.at(j - position.step)));
      beam_row.push_back(static_cast<std::uint32_t>(j - wraps * static_cast<double>(grid)));
    }
  }
}

template <typename Real>
typename GriddingPlan<Real>::Position GriddingPlan<Real>::position_of(double u) const {
  const double cycles = cycles_per_u * u, whole = std::floor(cycles);
  const bool turned = element_offset != 0 && std::fmod(whole, 2) != 0;
  return {(cycles - whole) * static_cast<double>(grid), turned ? -1.0 : 1.0};
}

template struct GriddingPlan<float>;
template struct GriddingPlan<double>;

}  // namespace insonify
