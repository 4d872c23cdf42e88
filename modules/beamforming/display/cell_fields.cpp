// SPDX-License-Identifier: BSD-3-Clause
// Fields of a display cell, of which its speckle is drawn, and their expected powers (E183).
#include <algorithm>
#include <cmath>
#include <limits>

#include "beamforming/display/cell_row_internal.hpp"
#include "beamforming/display/point_loops_internal.hpp"

namespace insonify {
namespace {

constexpr double shared_rounding = 1e-5;  // part of the louder of two cells that transforms leave in the other
constexpr std::uint64_t ping_seed = 0x9e3779b97f4a7c15, stage_seed = 0xd1b54a32d192ed03;  // odd, far from each other

/// Seed of the noise of a ping, far from those of the amplitudes of surfaces.
std::uint64_t noise_seed(const CellOptions& options) {
  return (options.seed ^ stage_seed) + static_cast<std::uint64_t>(options.ping) * ping_seed;
}

bool is_one_of(const std::vector<std::uint32_t>& ascending, std::uint32_t number) {
  return !ascending.empty() && std::binary_search(ascending.begin(), ascending.end(), number);
}

}  // namespace

void CellRow::sum_fields(std::size_t cell, std::size_t s) {
  Side& side = side_[s];
  for (auto& nodes : nodes_) std::fill(nodes.begin(), nodes.end(), 0);
  const PointsByCell& points = lists_.points;
  std::array<double*, field_parts> power;
  std::array<float*, field_parts - 1> shared;
  for (std::size_t q = 0; q < field_parts; ++q) power[q] = reinterpret_cast<double*>(power_at_[q].data()) + s;
  for (std::size_t q = 0; q + 1 < field_parts; ++q) shared[q] = reinterpret_cast<float*>(shared_at_[q].data()) + s;
  for (std::size_t k = points.first[cell]; k < points.first[cell + 1]; ++k) {
    const FieldPoint& point = points.point[k];
    const float response = row_.response.empty() ? 1 : static_cast<float>(row_.response[point.echo]);
    if (response == 0 || is_one_of(side.strong_numbers, point.echo)) continue;
    const FieldShares::Share& share = plan_.fields.share[point.share];
    const std::complex<float> pressure = response * std::complex<float>(point.re, point.im);
    const float square = response * response * point.power, near = square * share.near, far = square * share.far;
    nodes_[share.first][point.node] += share.near * pressure;
    nodes_[share.first + 1][point.node] += share.far * pressure;
    power[share.first][2 * point.node] += static_cast<double>(near * share.near);
    power[share.first + 1][2 * point.node] += static_cast<double>(far * share.far);
    shared[share.first][2 * point.node] += near * share.far;
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
  for (std::size_t q = 0; q + 1 < field_parts; ++q) sum_shared(q);
}

void CellRow::sum_shared(std::size_t q) {
  // From this power only a number of looks follows: single precision is enough.
  const std::size_t length = plan_.period, count = plan_.lag.size();
  plan_.field_to_elements.run(shared_at_[q].data(), at_elements_.data());
  for (std::size_t m = count; m <= length - count; ++m) at_elements_[m] = 0;
  for (std::size_t m = 0; m < count; ++m) {
    at_elements_[m] *= plan_.shared_weight[m];
    if (m > 0) at_elements_[length - m] *= plan_.shared_weight[m];
  }
  plan_.elements_to_field.run(at_elements_.data(), shared_.data() + guards_before);
  repeat_ends(shared_);
  for (std::size_t b = 0; b < drawn_.size(); ++b) {
    const std::complex<float> power = beams_.in_field[b].of(shared_.data());
    const double one = static_cast<double>(power.real()), other = static_cast<double>(power.imag());
    // Transforms leave a part of the louder cell in the other.
    side_[0].shared[q][b] = std::abs(one) > shared_rounding * std::abs(other) ? one : 0;
    side_[1].shared[q][b] = std::abs(other) > shared_rounding * std::abs(one) ? other : 0;
  }
}

}  // namespace insonify
