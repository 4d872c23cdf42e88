// SPDX-License-Identifier: BSD-3-Clause
// Facets of a Gaussian surface in Kirchhoff's limit of high frequency (Beckmann and Spizzichino 1963; shadowing by Smith
// 1967), of a solid whose reflection is that of an elastic half-space (Brekhovskikh and Lysanov, Fundamentals of Ocean
// Acoustics, section 4.2); what finer roughness takes from a facet's mirror image (Eckart 1953) it scatters diffusely.
#include <cmath>

#include "acoustics/reflection.hpp"
#include "acoustics/surface_laws.hpp"
#include "acoustics/tabulated_surface_internal.hpp"
#include "core/require.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

class RoughSurface final : public SurfaceScattering {
 public:
  RoughSurface(const RoughLaw& law, double frequency, double sound_speed)
      : slope_(law.slope),
        mu_(law.diffuse_mu),
        height_(4 * pi * frequency / sound_speed * law.micro_roughness),
        normal_(std::norm(rough_reflection(law, sound_speed, 1))),
        reflection_([&](double cosine) { return std::norm(rough_reflection(law, sound_speed, cosine)); }),
        back_([this](double cosine) {
          return cross_section({cosine, cosine, 1}) / cosine;
        }) {}

  double cross_section(const PathAngles& path) const override {
    const double ci = path.cos_in, co = path.cos_out;
    if (!(ci > 0 && co > 0)) return 0;
    const HalfVector half = half_vector(path);
    const double cos2 = half.cos_t * half.cos_t, s2 = slope_ * slope_;
    const double facets = std::exp((1 - 1 / cos2) / s2) / (4 * pi * s2 * cos2 * cos2);
    const double seen = facets_seen(slope_, std::min(ci, co));
    const double lobe = kept(half.cos_d) * reflection_(half.cos_d) * facets * seen;  // (E142)
    const double lost = height_ > 0 ? (1 - kept(ci)) * (1 - kept(co)) / (1 - kept(1)) : 0;
    return ci * co * (mu_ + normal_ / pi * lost) + lobe;  // (E143)
  }
  double back(double cosine) const override { return back_(cosine); }
  double lobe_slope() const override { return slope_; }

 private:
  /// Returns the share of the power in a facet's mirror image that its micro-roughness leaves.
  double kept(double cosine) const { return std::exp(-height_ * height_ * cosine * cosine); }

  double slope_, mu_, height_, normal_;
  CosineTable reflection_, back_;
};

}  // namespace

std::complex<double> rough_reflection(const RoughLaw& law, double sound_speed, double cos_incidence) {
  require(cos_incidence >= 0 && cos_incidence <= 1, "rough_reflection", "cos_incidence", cos_incidence, "",
          "within 0 and 1");
  if (!(law.density > 0)) return law.reflection;
  return reflection_coefficient({law.density, law.compression_speed, law.shear_speed}, cos_incidence, sea_water_density,
                                sound_speed);
}

std::shared_ptr<const SurfaceScattering> surface_of(const RoughLaw& law, double frequency, double sound_speed) {
  require_valid(SurfaceLaw(law), frequency, sound_speed, "surface_of");
  return std::make_shared<const RoughSurface>(law, frequency, sound_speed);
}

}  // namespace insonify
