// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/split_aperture.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/error.hpp"
#include "sonar/receive_array.hpp"

namespace insonify {
namespace {

constexpr std::size_t fewest_elements = 8;

/// `shading` read at `count` places spread over its whole length, linear in between, with this sum.
std::vector<double> resampled_shading(const std::vector<double>& shading, std::size_t count, double sum) {
  const double last = static_cast<double>(shading.size()) - 1;
  std::vector<double> weights(count);
  for (std::size_t j = 0; j < count; ++j) {
    const double position =
        std::clamp((static_cast<double>(j) + 0.5) / static_cast<double>(count) * (last + 1) - 0.5, 0.0, last);
    const auto low = std::min(static_cast<std::size_t>(position), shading.size() - 2);
    const double share = position - static_cast<double>(low);
    weights[j] = (1 - share) * shading[low] + share * shading[low + 1];
  }
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& w : weights) w *= sum / all;
  return weights;
}

}  // namespace

SonarHead half_aperture(const SonarHead& head, ApertureSide side, const char* who) {
  require_valid(head, who);
  if (head.column || fan_rows(head.fan).size() > 1 || !has_line(head))
    fail(ErrorKind::argument, who, ": a split aperture needs one row of beams of a line array; this head has ",
         head.column      ? "a planar array"
         : has_line(head) ? "several rows"
                          : "a curved array");
  const std::size_t elements = head.array.elements(), half = elements / 2;
  if (elements < fewest_elements)
    fail(ErrorKind::argument, who, ": a split aperture needs at least ", fewest_elements, " elements; this head has ",
         elements);
  SonarHead masked = head;
  const std::size_t first = side == ApertureSide::port ? elements - half : 0;  // (E92)
  std::fill(masked.array.shading.begin(), masked.array.shading.end(), 0.0);
  const std::vector<double> weights = resampled_shading(head.array.shading, half, static_cast<double>(elements));
  std::copy(weights.begin(), weights.end(), masked.array.shading.begin() + static_cast<std::ptrdiff_t>(first));
  return masked;
}

Grid<float> phase_between(const ComplexGrid& port, const ComplexGrid& starboard) {
  return (starboard * port.conjugate()).arg().cast<float>();
}

}  // namespace insonify
