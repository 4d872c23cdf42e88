// SPDX-License-Identifier: BSD-3-Clause
// Lambert's law and facets (Ellis and Crowe, Bistatic reverberation calculations using a three-dimensional scattering
// function, J. Acoust. Soc. Am. 89, 1991), of which rough_law.cpp has the physics and this law the fit.
#include <cmath>

#include "acoustics/surface_laws.hpp"
#include "acoustics/tabulated_surface_internal.hpp"

namespace insonify {
namespace {

class EllisCroweSurface final : public SurfaceScattering {
 public:
  explicit EllisCroweSurface(const EllisCroweLaw& law)
      : law_(law), back_([this](double cosine) {
          return cross_section({cosine, cosine, 1}) / cosine;
        }) {}

  double cross_section(const PathAngles& path) const override {
    if (!(path.cos_in > 0 && path.cos_out > 0)) return 0;
    const double cos2 = std::pow(half_vector(path).cos_t, 2), s2 = law_.facet_slope * law_.facet_slope;
    const double facets = law_.facet_strength / (cos2 * cos2) * std::exp((1 - 1 / cos2) / (2 * s2));
    return law_.diffuse_mu * path.cos_in * path.cos_out + facets;  // (E200)
  }
  double back(double cosine) const override { return back_(cosine); }
  double lobe_slope() const override { return std::sqrt(2) * law_.facet_slope; }

 private:
  EllisCroweLaw law_;
  CosineTable back_;
};

}  // namespace

std::shared_ptr<const SurfaceScattering> surface_of(const EllisCroweLaw& law, double frequency, double sound_speed) {
  require_valid(SurfaceLaw(law), frequency, sound_speed, "surface_of");
  return std::make_shared<const EllisCroweSurface>(law);
}

}  // namespace insonify
