#include <algorithm>
#include <cmath>

#include "acoustics/boundary_internal.hpp"
#include "acoustics/reflection.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {

std::complex<double> Boundary::reflection(double grazing) const {
  const double left = coherent_reflection_loss(wavenumber, rms_height, grazing);
  return bottom ? left * bottom_reflection(*bottom, grazing) : -left;
}

double Boundary::strongest_bounce(double range) const {
  const double sine = std::min(1.0, std::abs(head_height) / range);
  return coherent_reflection_loss(wavenumber, rms_height, std::asin(sine));
}

std::vector<Boundary> boundaries_of(const Environment& environment, const Pose& world_from_head,
                                    const Transmission& transmission, double tolerance, const char* who) {
  if (!environment.surface && !environment.bottom)
    fail(ErrorKind::argument, who, ": environment has neither surface nor bottom, must have one of them");
  const double head = world_from_head.translation().z();
  const Eigen::Vector3d up = world_from_head.linear().transpose() * Eigen::Vector3d::UnitZ();
  const double wavenumber = 2 * pi * transmission.pulse.centre_frequency / transmission.medium.sound_speed;
  std::vector<Boundary> boundaries;
  const auto add = [&](double height, double water_side, double rms_height, const FlatBottom* bottom) {
    boundaries.push_back(
        {height, water_side, head - height, up, rms_height, tolerance + 3 * rms_height, wavenumber, bottom});
    if (!(water_side * (head - height) > 0))
      fail(ErrorKind::argument, who, ": the head stands at height ", head, " m, must be ",
           bottom ? "above bottom.height = " : "below surface.height = ", height, " m");
  };
  if (environment.surface) add(environment.surface->height, -1, rms_wave_height(environment), nullptr);
  if (environment.bottom) add(environment.bottom->height, 1, environment.bottom->rms_height, &*environment.bottom);
  return boundaries;
}

}  // namespace insonify
