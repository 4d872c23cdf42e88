// SPDX-License-Identifier: BSD-3-Clause
// Backscatter of sea beds: Mourad and Jackson, "High frequency sonar equation models for bottom backscatter and forward
// loss" (OCEANS 1989); APL-UW High-Frequency Ocean Environmental Acoustic Models Handbook, TR 9407 (1994), section IV;
// Jackson and Richardson, High-Frequency Seafloor Acoustics (2007). Angles in degrees where the report compares them.
#include <cmath>
#include <numbers>

#include "acoustics/surface_laws.hpp"
#include "acoustics/tabulated_surface_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr double least_grazing_deg = 0.001, largest_exponent = 40;

/// Returns 1 / (1 + e^x), the weight of one model where another takes over.
double fade(double x) { return 1 / (1 + std::exp(std::clamp(x, -largest_exponent, largest_exponent))); }

/// Returns the cross-section per area of a Lambert surface that returns all it receives, the limit of a diffuse part.
double most_diffuse(double cos_in, double cos_out) { return cos_in * cos_out / pi; }

class SeabedModel {
 public:
  SeabedModel(const Sediment& sediment, double frequency, double sound_speed, const char* who)
      : bed_(sediment, frequency, sound_speed, who), normal_(std::norm(bed_.reflection(1))) {
    const double al = bed_.alpha, rho = bed_.rho, nu = bed_.nu;
    using std::pow, std::tgamma;
    a_ = pow(8 * al * al * tgamma(1 / (2 * al) + 0.5) / (tgamma(0.5) * tgamma(1 / al) * tgamma(1 / (2 * al))), 2 * al);
    b_ = pow(a_, (1 + 1 / al) / 2) * tgamma(1 / al) / (2 * al);
    q_ = bed_.c * pow(2, 1 - 2 * al) * pow(bed_.k, 2 - 2 * al);
    slope_ = std::sqrt(pow(2 * pi * bed_.w2, 1 / al) / (2 * (1 - al)) * pow(bed_.k * bed_.k / al, (1 - al) / al));
    share_ = pow(1000, 1 / (1 + al));
    critical_deg_ = nu >= 1.001 ? degrees(std::acos(1 / nu)) : 2.5613;
    impedance_ = pow((1 - 2 / rho) / (nu * nu) + 1, 2) * pow(nu, 3.25);
  }

  SeabedStrength at(double grazing) const { return {diffuse(grazing), lobe(std::cos(pi / 2 - grazing), 1)}; }

  /// The lobe of facets at cos_t from the normal for the wavenumber times `cos_d`.
  double lobe(double cos_t, double cos_d) const {
    const Relief relief = relief_at(cos_d);
    const double g = std::max(degrees(std::asin(std::min(1.0, cos_t))), least_grazing_deg);
    const double rough = large_roughness(relief);
    double sum = 0;
    if (rough < 1) sum += (1 - rough) * kirchhoff_share(relief, g) * kirchhoff(relief, g);
    const double steep = degrees(relief.slope);
    if (rough > 0)
      sum += rough * 0.026 * normal_ /
             (relief.slope * relief.slope * std::pow(1 + (g - 90) * (g - 90) / (2.6 * steep * steep), 1.9) * corner(g));
    return sum * std::norm(bed_.reflection(cos_d)) / normal_;
  }

  double diffuse(double grazing) const {
    const Relief relief = relief_at(1);
    const double g = std::max(degrees(grazing), least_grazing_deg), s = relief.slope;
    const double rough = large_roughness(relief), shadow = seen_share(std::tan(radians(g)) / s);
    const double small = shadow * over_slopes(g, s, [&](double sine) { return perturbation(sine); });
    const double volume = shadow * over_slopes(g, s, [&](double sine) { return volume_part(sine); });
    double sum = volume;
    if (rough < 1) sum += (1 - rough) * (1 - kirchhoff_share(relief, g)) * small;
    if (rough > 0) {
      const double m = 0.7263 * std::pow(s, -1.0 / 3);
      sum += rough * 0.04682 * std::pow(s, 1.25) * impedance_ / (1 + 3.54 * degrees(s) / critical_deg_) *
             std::pow(std::sin(pi / corner(g)), m);
    }
    return sum;  // (E139)
  }

  double slope() const { return relief_at(1).slope; }

 private:
  /// Relief that is coarse at one wavenumber: structure function q and rms slope.
  struct Relief {
    double q, slope;
  };
  Relief relief_at(double times) const {
    const double al = bed_.alpha;
    if (times == 1) return {q_, slope_};
    return {q_ * std::pow(times, 2 - 2 * al), slope_ * std::pow(times, (1 - al) / al)};
  }
  static double large_roughness(const Relief& relief) { return 1 - fade((degrees(std::atan(relief.slope)) - 7) / 0.5); }
  double corner(double g) const { return 1 + 0.81 * critical_deg_ * critical_deg_ / (g * g); }

  double kirchhoff(const Relief& relief, double g) const {
    if (g < 40) return 0;
    const double al = bed_.alpha, cosine = std::cos(radians(g)), sine = std::sin(radians(g));
    const double width = std::pow(cosine, 4 * al) + a_ * relief.q * relief.q * std::pow(sine, 4);
    return b_ * relief.q * normal_ / (8 * pi * std::pow(width, (1 + al) / (2 * al)));
  }
  /// Returns the share of the lobe where it and the composite model both hold.
  double kirchhoff_share(const Relief& relief, double g) const {
    const double al = bed_.alpha;
    const double c4 = share_ * std::pow(a_ * relief.q * relief.q, 1 / al);
    return fade((std::cos(radians(g)) - std::pow(1 / c4 + 4, -0.25)) / 0.0125);
  }

  /// First-order perturbation of the relief finer than the wave.
  double perturbation(double sine) const {
    const double rho = bed_.rho, k = bed_.k, cos2 = 1 - sine * sine;
    const std::complex<double> root = rho * sine + bed_.root(sine);
    const std::complex<double> y = ((rho - 1) * (rho - 1) * cos2 + rho * rho - bed_.kappa * bed_.kappa) / (root * root);
    return 4 * std::pow(k * sine, 4) * std::norm(y) * bed_.w2 *
           std::pow(4 * k * k * cos2 + k * k / 100, -0.5 * bed_.gamma);
  }
  double volume_part(double sine) const {
    const std::complex<double> root = bed_.root(sine), r = bed_.reflection(sine);
    return 5 * bed_.delta * bed_.sigma2 * std::norm(1.0 - r * r) * sine * sine /
           (bed_.nu * std::numbers::ln10 * std::norm(root) * root.imag());
  }
  /// Mean over the slopes of the coarse relief, by three nodes.
  template <typename Of>
  static double over_slopes(double g, double s, const Of& of_sine) {
    double sum = 0;
    for (const auto& [x, w] : {std::pair{1.224745, 0.29541}, {0.0, 1.181636}, {-1.224745, 0.29541}})
      sum += w * of_sine(std::sin(radians(std::clamp(g - x * degrees(s), 0.0, 90.0))));
    return sum / std::sqrt(pi);
  }
  /// Returns the share of the bed that the coarse relief leaves out of shadow.
  static double seen_share(double t) {
    if (t > 2) return 1;
    const double q = (std::exp(-t * t) / std::sqrt(pi) - t * std::erfc(t)) / (4 * t);
    return -std::expm1(-2 * q) / (2 * q);
  }

  FluidBed bed_;
  double normal_;  ///< reflection of power at normal incidence
  double a_ = 0, b_ = 0, critical_deg_ = 0, impedance_ = 0;
  double q_ = 0, slope_ = 0, share_ = 0;
};

class SeabedSurface final : public SurfaceScattering {
 public:
  SeabedSurface(const SeabedLaw& law, double frequency, double sound_speed)
      : model_(law, frequency, sound_speed, "surface_of"),
        slope_(model_.slope()),
        diffuse_([this](double cosine) { return std::sqrt(model_.diffuse(std::asin(cosine))); }),
        limit_(energy_limits()),
        back_([this](double cosine) {
          return cross_section({cosine, cosine, 1}) / cosine;
        }) {}
  double cross_section(const PathAngles& path) const override {
    if (!(path.cos_in > 0 && path.cos_out > 0)) return 0;
    return diffuse(path) + lobe(path) * limit(std::min(path.cos_in, path.cos_out));  // (E140)
  }
  double back(double cosine) const override { return back_(cosine); }
  double lobe_slope() const override { return std::min(1.0, slope_); }

 private:
  static constexpr int limits = 12;

  double diffuse(const PathAngles& path) const {
    return std::min(diffuse_(path.cos_in) * diffuse_(path.cos_out), most_diffuse(path.cos_in, path.cos_out));
  }
  double lobe(const PathAngles& path) const {
    const HalfVector half = half_vector(path);
    return model_.lobe(half.cos_t, half.cos_d) * facets_seen(slope_, std::min(path.cos_in, path.cos_out));
  }
  /// Returns the share of the lobe that energy allows, from grazing to normal incidence; never more towards grazing.
  std::vector<double> energy_limits() const {
    constexpr double all = 0.985;  // less the error of so few directions
    std::vector<double> limit(limits + 1, 1);
    for (int k = limits; k >= 0; --k) {
      const double cosine = std::max(0.02, static_cast<double>(k) / limits);
      const double of_lobe = power_share(lobe_slope(), cosine, 256, [this](const PathAngles& p) { return lobe(p); });
      const double rest = all - power_share(0, cosine, 256, [this](const PathAngles& p) { return diffuse(p); });
      limit[static_cast<std::size_t>(k)] = of_lobe > rest ? std::max(0.0, rest / of_lobe) : 1;
    }
    for (std::size_t k = limits; k > 0; --k) limit[k - 1] = std::min(limit[k - 1], limit[k]);
    return limit;
  }
  double limit(double cosine) const {
    const double x = cosine * limits;
    const std::size_t left = std::min<std::size_t>(static_cast<std::size_t>(x), limits - 1);
    return limit_[left] + (x - static_cast<double>(left)) * (limit_[left + 1] - limit_[left]);
  }

  SeabedModel model_;
  double slope_;
  CosineTable diffuse_;
  std::vector<double> limit_;
  CosineTable back_;
};

}  // namespace

SeabedStrength seabed_strength(const Sediment& sediment, double frequency, double sound_speed, double grazing) {
  return SeabedModel(sediment, frequency, sound_speed, "seabed_strength").at(grazing);
}

double seabed_cut_db(const Sediment& sediment, double frequency, double sound_speed, double grazing) {
  const auto [diffuse, lobe] = SeabedModel(sediment, frequency, sound_speed, "seabed_cut_db").at(grazing);
  return db_from_power((diffuse + lobe) /
                       (std::min(diffuse, most_diffuse(std::sin(grazing), std::sin(grazing))) + lobe));
}

std::shared_ptr<const SurfaceScattering> surface_of(const SeabedLaw& law, double frequency, double sound_speed) {
  return std::make_shared<const SeabedSurface>(law, frequency, sound_speed);
}

}  // namespace insonify
