// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/surface_scattering.hpp"

#include <algorithm>
#include <cmath>

#include "acoustics/tabulated_surface_internal.hpp"
#include "core/units.hpp"

namespace insonify {

using Eigen::Vector3d;
double lambert_cross_section(double lambert_mu, double cos_back, double seen_area) {
  return lambert_mu * cos_back * seen_area;  // (E4)
}

double cross_section(const SurfaceScattering& surface, const InsonifiedPatch& patch) {
  if (!(patch.cos_out > 0 && patch.cos_back > 0)) return 0;
  return surface.per_seen_area({patch.cos_out, patch.cos_back, patch.cos_between}) * patch.seen_area;
}

Vector3d sampled_direction(double lobe_slope, const Vector3d& in, double number, double turn) {
  const bool facets = lobe_slope > 0 && number >= 0.5;
  if (lobe_slope > 0) number = facets ? 2 * number - 1 : 2 * number;
  const double cosine =
      facets ? 1 / std::sqrt(1 - lobe_slope * lobe_slope * std::log1p(-number)) : std::sqrt(1 - number);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const Vector3d direction(sine * std::cos(2 * pi * turn), sine * std::sin(2 * pi * turn), cosine);
  return facets ? Vector3d(2 * in.dot(direction) * direction - in) : direction;
}

double sampling_density(double lobe_slope, const PathAngles& path) {
  const double diffuse = std::max(0.0, path.cos_out) / pi;
  if (!(lobe_slope > 0)) return diffuse;
  const double cos_d = std::sqrt(std::max(0.0, 0.5 * (1 + path.cos_between)));
  const double cos_t = (path.cos_in + path.cos_out) / (2 * cos_d);
  if (!(cos_t > 0)) return 0.5 * diffuse;
  const double square = cos_t * cos_t, s2 = lobe_slope * lobe_slope;
  const double facets = std::exp((1 - 1 / square) / s2) / (pi * s2 * square * square) * cos_t / (4 * cos_d);
  return 0.5 * (diffuse + facets);  // (E138)
}

double albedo(const SurfaceScattering& surface, double cos_in) {
  return power_share(surface.lobe_slope(), cos_in, 8192,
                     [&](const PathAngles& path) { return surface.cross_section(path); });
}

}  // namespace insonify
