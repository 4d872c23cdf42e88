// SPDX-License-Identifier: BSD-3-Clause
// Fields of a display cell, of which its speckle is drawn, and their expected powers (E183).
#include <algorithm>
#include <cmath>
#include <limits>

#include "beamforming/display/cell_row_internal.hpp"
#include "beamforming/display/looks_loops_internal.hpp"

namespace insonify {
namespace {

constexpr std::uint64_t ping_seed = 0x9e3779b97f4a7c15, stage_seed = 0xd1b54a32d192ed03;  // odd, far from each other

/// Seed of the noise of a ping, far from those of the amplitudes of surfaces.
std::uint64_t noise_seed(const CellOptions& options) {
  return (options.seed ^ stage_seed) + static_cast<std::uint64_t>(options.ping) * ping_seed;
}

}  // namespace

void CellRow::sum_fields(std::size_t cell, std::size_t s) {
  Side& side = side_[s];
  for (auto& nodes : nodes_) std::fill(nodes.begin(), nodes.end(), 0);
  const double per_part = static_cast<double>(field_parts) / plan_.cell_length,
               first = (plan_.first_range + static_cast<double>(cell) * plan_.cell_length) * per_part - 0.5;
  // Parts of long cells that meet at an edge have amplitudes of their own, as parts of one cell that meet.
  const std::size_t odd = plan_.noise_of_next > 0 ? 0 : cell % 2;
  for (const Piece& piece : side.even) {
    const CellEcho& echo = *piece.echo;
    // The echo is in two parts, as a box of their length.
    const double place = static_cast<double>(echo.range) * per_part - first;
    if (!(echo.root > 0 && place > 0 && place < static_cast<double>(field_parts + 1))) continue;
    const auto far = static_cast<std::size_t>(place);
    const float share = static_cast<float>(place) - static_cast<float>(far), root = piece.response * echo.root;
    const std::size_t node = plan_.node_of(echo.u);
    std::size_t position = node;
    while (position >= plan_.period) position -= plan_.period;
    const std::complex<float> turn = plan_.half_positions ? plan_.turn[node] : 1;
    const auto add = [&](std::size_t q, float part) {
      const std::complex<float>& of = q % 2 == odd ? echo.pressure : echo.aside;
      const float a = root * std::sqrt(part), re = a * of.real(), im = a * of.imag();
      nodes_[q][position] +=
          std::complex<float>{turn.real() * re - turn.imag() * im, turn.real() * im + turn.imag() * re};
      reinterpret_cast<double*>(&power_at_[q][position])[s] += static_cast<double>(a) * static_cast<double>(a);
    };
    if (far > 0) add(far - 1, 1 - share);
    if (far < field_parts) add(far, share);
  }
  for (std::size_t q = 0; q < field_parts; ++q) {
    plan_.field_to_elements.run(nodes_[q].data(), at_elements_.data());
    add_noise(cell, q, side.noise / static_cast<double>(field_parts));
    form_field(side.field[q]);
  }
}

void CellRow::add_noise(std::size_t cell, std::size_t q, double noise) {
  const double root = std::sqrt(noise / plan_.lag[0]), next = q + 1 == field_parts ? plan_.noise_of_next : 0;
  if (root == 0) return;
  add_noise_of(cell, q, root * std::sqrt(1 - next * next));
  if (next > 0) add_noise_of(cell + 1, 0, root * next);  // (E224)
}

void CellRow::add_noise_of(std::size_t cell, std::size_t q, double amplitude) {
  for (std::size_t m = 0; m < noise_id_.size(); ++m)
    noise_id_[m] = ((row_.first_element + m) * (plan_.cells + 1) + cell) * field_parts + q;
  kernels::draw_normals(noise_seed(options_), noise_id_.data(), noise_id_.size(), noise_re_.data(), noise_im_.data());
  std::size_t at = plan_.first_element;
  for (std::size_t m = 0; m < noise_id_.size(); ++m) {
    at_elements_[at] +=
        std::complex<float>{static_cast<float>(amplitude * noise_re_[m]), static_cast<float>(amplitude * noise_im_[m])};
    if (++at == plan_.period) at = 0;
  }
}

void CellRow::form_field(Field& samples) {
  const std::size_t count = plan_.element_weight.size(), length = plan_.period;
  std::size_t from = plan_.first_element, to = length - count / 2;
  for (std::size_t m = 0; m < count; ++m) {
    weighted_[to] = plan_.element_weight[m] * at_elements_[from];
    if (++from == length) from = 0;
    if (++to == length) to = 0;
  }
  plan_.elements_to_field.run(weighted_.data(), samples.data() + guards_before);
  repeat_ends(samples);
}

void CellRow::sum_powers(std::size_t sides) {
  // Expected powers of the fields of both cells, as real and imaginary parts.
  const std::size_t length = plan_.period;
  const Complex noise = Complex(side_[0].noise, sides > 1 ? side_[1].noise : 0) / static_cast<double>(field_parts);
  for (std::size_t q = 0; q < field_parts; ++q) {
    plan_.to_elements.run(power_at_[q].data(), elements_.data());
    for (std::size_t m = 0; m < plan_.lag.size(); ++m) {
      lags_[m] = plan_.lag_weight[m] * elements_[m];
      if (m > 0) lags_[length - m] = plan_.lag_weight[m] * elements_[length - m];
    }
    lags_[0] += plan_.lag_weight[0] / plan_.lag[0] * noise;
    plan_.to_period.run(lags_.data(), power_.data() + guards_before);
    repeat_ends(power_);
    for (std::size_t b = 0; b < drawn_.size(); ++b) {
      const Complex power = beams_.in_power[b].of(power_.data());
      const double least = std::numeric_limits<double>::min();
      side_[0].power[q][b] = std::max({power.real(), noise.real(), least});
      side_[1].power[q][b] = std::max({power.imag(), noise.imag(), least});
    }
  }
}

}  // namespace insonify
