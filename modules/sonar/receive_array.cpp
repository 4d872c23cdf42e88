// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/receive_array.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/bisect.hpp"
#include "core/units.hpp"

namespace insonify {

using Eigen::Vector3d;

ReceiveArray::ReceiveArray(const SonarHead& head, std::vector<Vector3d> position)
    : spacing_(head.array.spacing), shading_(head.array.shading), position_(std::move(position)) {}

double ReceiveArray::length() const {
  const auto across = [](const Vector3d& p) { return p.y(); };
  const auto [low, high] = std::ranges::minmax_element(position_, {}, across);
  return high->y() - low->y() + spacing_;
}

double ReceiveArray::steering_phase(std::size_t m, const Vector3d& beam, double wavelength) const {
  return 2 * pi / wavelength * position_[m].dot(beam);
}

std::complex<double> ReceiveArray::response(const Vector3d& from, const Vector3d& beam, double wavelength) const {
  const Vector3d step = -2 * pi / wavelength * (from - beam);
  std::complex<double> sum = 0;
  for (std::size_t m = 0; m < shading_.size(); ++m) sum += std::polar(1.0, step.dot(position_[m])) * shading_[m];
  return sum / static_cast<double>(shading_.size());  // (E205)
}

double ReceiveArray::beam_width(double wavelength) const {
  const auto power = [&](double azimuth) {
    return std::norm(response(unit_vector({azimuth, 0}), Vector3d::UnitX(), wavelength));
  };
  return 2 * half_power_point(power, 0.02 * wavelength / length(), pi / 2);
}

bool ReceiveArray::has_further_lobes(const BeamFan& fan, double wavelength) const {
  const double step = 0.25 * wavelength / length();
  const auto [first, last] = std::ranges::minmax_element(fan.azimuth);
  for (const double azimuth : {*first, *last})
    for (double other = -pi / 2; other <= pi / 2; other += step) {
      const Vector3d beam = unit_vector({azimuth, fan.elevation[0]}), from = unit_vector({other, fan.elevation[0]});
      if (std::abs(other - azimuth) > main_lobe_reach * fan.beam_width &&
          std::norm(response(from, beam, wavelength)) > 0.5)
        return true;
    }
  return false;
}

double ReceiveArray::directivity_index_db(double wavelength) const {
  double sum = 0;
  for (std::size_t i = 0; i < shading_.size(); ++i)
    for (std::size_t j = 0; j < shading_.size(); ++j) {
      const Vector3d apart = 2 * pi / wavelength * (position_[i] - position_[j]);
      const double x = apart.norm();
      sum += shading_[i] * shading_[j] * std::cos(apart.x()) * (x > 0 ? std::sin(x) / x : 1);
    }
  return -db_from_power(sum / std::pow(static_cast<double>(shading_.size()), 2));  // (E206)
}

std::unique_ptr<const ReceiveArray> receive_array(const SonarHead& head) {
  return array_kinds[static_cast<std::size_t>(head.array_shape)].make(head);
}

bool has_line(const SonarHead& head) { return receive_array(head)->line() != nullptr; }

Vector3d ahead(double u, double v) { return {std::sqrt(std::max(0.0, 1 - u * u - v * v)), u, v}; }

std::vector<Vector3d> beam_axes(const BeamFan& fan) {
  std::vector<Vector3d> axes;
  for (std::size_t b = 0; b < fan.beams(); ++b) axes.push_back(unit_vector({fan.azimuth[b], fan.elevation[b]}));
  return axes;
}

}  // namespace insonify
