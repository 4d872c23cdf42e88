// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/reflection.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/require.hpp"
#include "core/units.hpp"

namespace insonify {

std::complex<double> bottom_reflection(const FlatBottom& bottom, double grazing) {
  if (!(grazing >= 0 && grazing <= pi / 2))
    fail(ErrorKind::argument, "bottom_reflection: grazing = ", grazing, " rad, must be within 0 and pi/2");
  const double cosine = std::cos(grazing);
  // The time factor is exp(-i omega t): a wave that fades on its way has a positive imaginary part, and the principal
  // root keeps it so.
  const std::complex<double> n = std::complex<double>(1, bottom.loss) / bottom.sound_speed_ratio;
  const std::complex<double> q = std::sqrt(n * n - cosine * cosine);
  const double p = bottom.density_ratio * std::sin(grazing);
  if (p + q == 0.0) return (bottom.density_ratio - 1) / (bottom.density_ratio + 1);  // as fast as water: the limit
  return (p - q) / (p + q);                                                          // (E45)
}

std::complex<double> reflection_coefficient(const ElasticSolid& solid, double cosine, double density,
                                            double sound_speed) {
  constexpr const char* me = "reflection_coefficient";
  require(cosine >= 0 && cosine <= 1, me, "cosine", cosine, "", "within 0 and 1");
  require(solid.density > 0 && std::isfinite(solid.density), me, "solid.density", solid.density, "kg/m^3", "> 0");
  require(solid.pressure_speed > 0 && std::isfinite(solid.pressure_speed), me, "solid.pressure_speed",
          solid.pressure_speed, "m/s", "> 0");
  require(solid.shear_speed >= 0 && std::isfinite(solid.shear_speed), me, "solid.shear_speed", solid.shear_speed, "m/s",
          ">= 0");
  const double sine_2 = 1 - cosine * cosine, p = solid.pressure_speed / sound_speed,
               s = solid.shear_speed / sound_speed;
  const std::complex<double> cos_p = std::sqrt(std::complex<double>(1 - p * p * sine_2)),
                             cos_s = std::sqrt(std::complex<double>(1 - s * s * sine_2));
  const double sin_s_2 = s * s * sine_2, cos_2s = 1 - 2 * sin_s_2;
  // Both impedances times cosine cos_p, so that none is infinite: sin^2(2 s) / cos_s = 4 sin_s^2 cos_s.
  const std::complex<double> inside =
      solid.density * cosine *
      (solid.pressure_speed * cos_2s * cos_2s + 4 * solid.shear_speed * sin_s_2 * cos_s * cos_p);
  const std::complex<double> water = density * sound_speed * cos_p;
  if (inside + water == 0.0) return -1;
  return (inside - water) / (inside + water);  // (E148)
}

double rms_wave_height(double wind_speed) {
  if (!(wind_speed >= 0 && std::isfinite(wind_speed)))
    fail(ErrorKind::argument, "rms_wave_height: wind_speed = ", wind_speed, " m/s, must be finite and >= 0");
  constexpr double phillips = 0.0081, cut_off = 0.74, gravity = 9.81, wind_at_19m_to_10m = 1.026;
  const double wind = wind_at_19m_to_10m * wind_speed;
  return std::sqrt(phillips / cut_off) * wind * wind / (2 * gravity);  // (E46)
}

double rms_wave_height(const Environment& environment) {
  if (environment.surface && environment.surface->rms_height) return *environment.surface->rms_height;
  return environment.wind_speed ? rms_wave_height(*environment.wind_speed) : 0;
}

double coherent_reflection_loss(double wavenumber, double rms_height, double grazing) {
  const double roughness = wavenumber * rms_height * std::sin(grazing);
  return std::exp(-2 * roughness * roughness);  // (E47)
}

}  // namespace insonify
