// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "sonar/receive_array.hpp"

namespace insonify {
namespace {

std::vector<Eigen::Vector3d> places_on_arc(const SonarHead& head) {
  std::vector<Eigen::Vector3d> places;
  for (std::size_t m = 0; m < head.array.elements(); ++m) {
    const double angle = head.array.spacing / head.array_radius * element_position(m, head.array.elements());
    places.emplace_back(head.array_radius * std::cos(angle), head.array_radius * std::sin(angle), 0);  // (E205)
  }
  return places;
}

/// An arc about the origin. Each beam is steered by the delays of all elements; echoes carry no sign of x.
class CurvedArray final : public ReceiveArray {
 public:
  explicit CurvedArray(const SonarHead& head) : ReceiveArray(head, places_on_arc(head)) {}

  void require_valid(const SonarHead& head, const char* who) const override {
    if (head.column || head.fan.row_width > 0 || fan_rows(head.fan).size() > 1)
      fail(ErrorKind::argument, who, ": a curved array must have one row of beams, and no column");
    for (const double azimuth : head.fan.azimuth)
      if (std::abs(azimuth) > radians(80))
        fail(ErrorKind::argument, who, ": fan.azimuth has ", degrees(azimuth),
             " deg, must be within -80 and 80 for a curved array, which does not tell ahead from astern there");
    const double arc = spacing_ / head.array_radius * static_cast<double>(shading_.size());
    if (arc > 2 * pi + 1e-9)
      fail(ErrorKind::argument, who, ": ", shading_.size(), " elements on an arc span ", degrees(arc),
           " deg, must be at most 360; use a larger array_radius");
  }
  double bent_by(const BeamFan& fan, double half_extent) const override {
    double widest = 0;
    for (const Eigen::Vector3d& axis : beam_axes(fan)) widest = std::max(widest, std::abs(axis.y()));
    return widest * (1 - std::cos(half_extent));
  }
};

}  // namespace

std::unique_ptr<const ReceiveArray> curved_array(const SonarHead& head) { return std::make_unique<CurvedArray>(head); }

}  // namespace insonify
