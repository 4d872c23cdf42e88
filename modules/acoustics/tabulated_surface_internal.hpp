// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "acoustics/surface_scattering.hpp"
#include "core/units.hpp"
#include "scene/surface_law.hpp"

// Private to the laws of surfaces.
namespace insonify {

/// A function of a cosine in (0, 1] between entries of a table, even in sqrt(1 - cosine), which is the angle itself
/// near normal incidence: 0.04 degrees apart.
class CosineTable {
 public:
  template <typename Function>
  explicit CosineTable(const Function& of_cosine) : value_(entries + 1) {
    for (std::size_t k = 0; k <= entries; ++k) {
      const double x = static_cast<double>(k) / entries;
      value_[k] = of_cosine(std::max(1e-6, 1 - x * x));
    }
  }
  double operator()(double cosine) const {
    const double x = std::sqrt(std::clamp(1 - cosine, 0.0, 1.0)) * entries;
    const std::size_t left = std::min(static_cast<std::size_t>(x), entries - 1);
    return value_[left] + (x - static_cast<double>(left)) * (value_[left + 1] - value_[left]);
  }

 private:
  static constexpr std::size_t entries = 2048;
  std::vector<double> value_;
};

/// The direction half way between the two directions of a path.
struct HalfVector {
  double cos_t;  ///< cosine of its angle to the normal
  double cos_d;  ///< cosine of incidence on a facet that faces it
};
inline HalfVector half_vector(const PathAngles& path) {
  const double cos_d = std::sqrt(std::clamp(0.5 * (1 + path.cos_between), 1e-12, 1.0));
  return {std::min(1.0, (path.cos_in + path.cos_out) / (2 * cos_d)), cos_d};
}

/// Returns the fraction of a surface with facets of rms slope `slope` that lies outside their shadows (Smith 1967).
inline double facets_seen(double slope, double cosine) {
  const double n = cosine / (std::sqrt(std::max(1e-12, 1 - cosine * cosine)) * slope);
  return n > 4 ? 1 : 1 / (1 + 0.5 * (std::exp(-n * n) / (n * std::sqrt(pi)) - std::erfc(n)));
}

/// Returns the integral of a cross-section over all directions, divided by cos_in, from an even number `count` of
/// directions of sampled_direction on a golden lattice.
template <typename CrossSection>
double power_share(double lobe_slope, double cos_in, int count, const CrossSection& cross_section) {
  constexpr double golden = 0.6180339887498949;
  const Eigen::Vector3d in(std::sqrt(std::max(0.0, 1 - cos_in * cos_in)), 0, cos_in);
  double sum = 0;
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector3d out =
        sampled_direction(lobe_slope, in, (k + 0.5) / count, std::fmod(golden * (k % (count / 2)), 1.0));
    if (!(out.z() > 0)) continue;
    const PathAngles path{cos_in, out.z(), in.dot(out)};
    sum += cross_section(path) / sampling_density(lobe_slope, path);
  }
  return sum / (count * cos_in);
}

/// A sediment as a fluid: its refraction and reflection (E45), and its relief.
struct FluidBed {
  FluidBed(const Sediment& sediment, double frequency, double sound_speed, const char* who);
  std::complex<double> root(double sine) const { return std::sqrt(kappa * kappa - (1 - sine * sine)); }
  std::complex<double> reflection(double sine) const {
    const std::complex<double> p = root(sine);
    if (rho * sine + p == 0.0) return (rho - 1) / (rho + 1);  // as fast as water: the limit
    return (rho * sine - p) / (rho * sine + p);               // (E45)
  }

  double rho, nu, delta, sigma2, w2, gamma;
  double alpha;  ///< gamma / 2 - 1
  double k;      ///< wavenumber in the water [1/cm]
  double c;      ///< coefficient of the structure function, from w2 [cm]
  std::complex<double> kappa;
};

/// Throws Error unless frequency [Hz] and sound speed [m/s] are finite and > 0, and the law is valid.
void require_valid(const SurfaceLaw& law, double frequency, double sound_speed, const char* who);

}  // namespace insonify
