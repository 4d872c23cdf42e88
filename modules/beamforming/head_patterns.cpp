// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/head_patterns.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "sonar/element_kernels_internal.hpp"

namespace insonify {

EchoOptions with_patterns(EchoOptions options, const SonarHead& head) {
  require_valid(head.fan, "with_patterns");
  const auto [low, high] = std::ranges::minmax(head.fan.elevation);
  const bool own_pattern = !head.column && low != high;  // synthesize applies that of each row
  options.elevation_shape = head.elevation_shape;
  options.elevation_width = own_pattern ? 0 : head.fan.elevation_width;
  options.elevation_centre = (low + high) / 2;
  options.transmit_width = head.transmit_width;
  return options;
}

double sampled_half_extent(const SonarHead& head, double floor_db) {
  require_valid(head.fan, "sampled_half_extent");
  const double half = elevation_half_extent(head.elevation_shape, head.fan.elevation_width, floor_db);
  if (!head.column) return half;
  // The transmitter's pattern is centred on the middle of the rows; beams outside it still receive from one beam width
  // around them.
  const auto [low, high] = std::ranges::minmax(head.fan.elevation);
  return std::max(half - (high - low) / 2, std::min(head.fan.row_width, pi / 2));
}

RowResponse::RowResponse(const SonarHead& head, double wavelength, double row_elevation)
    : head_(head), elevation_(row_elevation), v_(std::sin(row_elevation)), step_(0) {
  if (!head.column) return;
  step_ = 2 * pi * head.column->spacing / wavelength;
  re_.resize(head.column->elements());
  im_.resize(head.column->elements());
}

double RowResponse::at(double v) {
  if (!head_.column)
    return elevation_response(head_.elevation_shape, head_.fan.elevation_width,
                              std::asin(std::clamp(v, -1.0, 1.0)) - elevation_);
  kernels::element_phases(step_ * (v - v_), re_.size(), re_.data(), im_.data());
  double sum = 0;
  for (std::size_t k = 0; k < re_.size(); ++k) sum += head_.column->shading[k] * re_[k];
  return sum / static_cast<double>(re_.size());  // (E56)
}

}  // namespace insonify
