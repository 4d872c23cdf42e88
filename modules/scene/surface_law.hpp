// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/units.hpp"

namespace insonify {

/// Properties of a law that code outside it asks for. Each law states them in a constant `traits`. A law may also have the
/// members `std::string problem() const`, which returns the defect of its numbers together (problem_of), and
/// `LawValidity validity(double frequency) const` (validity_of).
struct LawTraits {
  const char* name;  ///< word for the law in files
  bool own_slopes;   ///< true: the law includes slopes of facets, which micro-relief of the surface would count twice
  bool merges;       ///< true: the mean over surfels of different slopes is known (E137), so that they may be merged
};

/// Frequencies at which a law is known to hold, and its possible error elsewhere.
struct LawValidity {
  double least = 0, most = HUGE_VAL;  ///< [Hz], included
  const char* source = "";            ///< where the limits come from
  double error_db = 0;                ///< possible error at other frequencies [dB]
};

/// Lambert's law (E4). Its coefficient is Material::lambert_mu.
struct LambertLaw {
  static constexpr LawTraits traits{.name = "lambert", .own_slopes = false, .merges = true};
  bool operator==(const LambertLaw&) const = default;
};

/// A sea bed as the six numbers of APL-UW TR 9407 (1994); by default medium sand.
struct Sediment {
  double density_ratio = 1.845;               ///< density over that of water
  double speed_ratio = 1.1782;                ///< sound speed over that of water
  double loss = 0.01624;                      ///< imaginary over real part of the wavenumber
  double volume_parameter = 0.002;            ///< ratio of volume scattering to attenuation
  double spectral_strength_cm4 = 0.00444600;  ///< spectral strength of the relief at 1 / cm
  double spectral_exponent = 3.25;            ///< spectral exponent of the relief
  double grain_size = 0;  ///< [m]; frequencies count as at most sound speed / (pi grain size); 0: unknown
  LawValidity validity(double frequency) const;  ///< TR 9407 for its own frequencies
  bool operator==(const Sediment&) const = default;
};

/// The scattering of a sea bed by roughness and volume, by TR 9407 (E139, E140).
struct SeabedLaw : Sediment {
  static constexpr LawTraits traits{.name = "seabed", .own_slopes = true, .merges = false};
  bool operator==(const SeabedLaw&) const = default;
};

/// The scattering of a sea bed by the small-slope approximation (E141): bistatic, for sand and mud.
struct SmallSlopeLaw : Sediment {
  static constexpr LawTraits traits{.name = "small_slope", .own_slopes = true, .merges = false};
  LawValidity validity(double frequency) const;  ///< valid to 300 kHz
  bool operator==(const SmallSlopeLaw&) const = default;
};

/// Facets of a solid or fluid with finer roughness on them, for metal, concrete and rock (E142, E143).
struct RoughLaw {
  static constexpr LawTraits traits{.name = "rough", .own_slopes = true, .merges = false};
  double slope = 0.2;            ///< rms slope of the facets over both axes
  double micro_roughness = 0;    ///< rms height on a facet [m]
  double diffuse_mu = 0;         ///< coefficient of the added Lambert's law [1/sr]
  double reflection = 1;         ///< reflection coefficient of pressure at all angles; unused if density is given
  double density = 0;            ///< [kg/m^3]; 0: see reflection
  double compression_speed = 0;  ///< speed of compression waves [m/s]
  double shear_speed = 0;        ///< speed of shear waves [m/s]; 0: a fluid
  std::string problem() const;   ///< a density needs speeds
  bool operator==(const RoughLaw&) const = default;
};

/// Lambert's law and a lobe of facets about the mirror direction (E200), as fitted to measured bistatic levels.
struct EllisCroweLaw {
  static constexpr LawTraits traits{.name = "ellis_crowe", .own_slopes = true, .merges = false};
  double diffuse_mu = 0.002;      ///< coefficient of Lambert's law [1/sr]
  double facet_strength = 0.1;    ///< cross-section per area straight back at normal incidence [1/sr]
  double facet_slope = 0.176327;  ///< rms slope of the facets along one axis; 10 degrees
  bool operator==(const EllisCroweLaw&) const = default;
};

/// A measured backscattering strength (E144).
struct TableLaw {
  static constexpr LawTraits traits{.name = "table", .own_slopes = false, .merges = false};
  std::vector<double> incidence;  ///< [rad], ascending from 0 to 75 degrees or more, below 90
  std::vector<double> frequency;  ///< [Hz], ascending; empty: the strength does not depend on frequency
  std::vector<double> sigma_db;   ///< [dB re 1/sr] = 10 log10 of the cross-section per area, frequency by frequency
  bool half_vector = false;  ///< true: bistatic strength is that at the half vector (lobes); false: the geometric mean
  std::string problem() const;                   ///< angles ascend from 0 to 75 degrees or more
  LawValidity validity(double frequency) const;  ///< valid from the first to the last frequency
  bool operator==(const TableLaw&) const = default;
};

/// The law by which a surface scatters. This list is the table of laws.
using SurfaceLaw = std::variant<LambertLaw, SeabedLaw, SmallSlopeLaw, RoughLaw, EllisCroweLaw, TableLaw>;

/// Returns the traits of a law.
inline const LawTraits& traits_of(const SurfaceLaw& law) {
  return std::visit([](const auto& l) -> const LawTraits& { return l.traits; }, law);
}
/// Returns the name of a law.
inline const char* name_of(const SurfaceLaw& law) { return traits_of(law).name; }
/// Returns each law with its default numbers, in the order of SurfaceLaw.
std::vector<SurfaceLaw> surface_laws();
/// Returns the law of this name with its default numbers; nothing for an unknown name.
std::optional<SurfaceLaw> law_named(std::string_view name);

/// Description of one number of laws, for checks, material files, comment lines of clouds, and tiles.
struct LawNumber {
  double* (*in)(SurfaceLaw&);  ///< returns the number in a law, nullptr if the law does not have it
  const char* name;            ///< name of the member, also in comment lines
  const char* unit;            ///< "": none
  double least, most;          ///< [unit]
  bool above;                  ///< true: the number must be greater than `least`
  const char* key;             ///< key in material files
  const char* file_unit;
  double in_file;    ///< file units in one unit
  bool in_decibels;  ///< true: files hold 10 log10 of the number
  bool required;     ///< true: files must give the number
  const char* help;  ///< description for the docs
};

namespace law_members {
/// Returns the number `member` of a law; nullptr if the law does not have it.
template <typename Law, double Law::*member>
double* of(SurfaceLaw& law) {
  return std::visit(
      [](auto& l) -> double* {
        if constexpr (std::is_base_of_v<Law, std::remove_reference_t<decltype(l)>>)
          return &(l.*member);
        else
          return nullptr;
      },
      law);
}
/// Returns the coefficient of the diffuse part of a law; nullptr if the law has none.
inline double* diffuse_mu(SurfaceLaw& law) {
  double* const rough = of<RoughLaw, &RoughLaw::diffuse_mu>(law);
  return rough ? rough : of<EllisCroweLaw, &EllisCroweLaw::diffuse_mu>(law);
}
}  // namespace law_members

/// All numbers of all laws.
inline constexpr LawNumber law_numbers[] = {
    {law_members::of<Sediment, &Sediment::density_ratio>, "density_ratio", "", 0.5, 10, false, "density_ratio", "", 1,
     false, true, "laws seabed and small_slope: density of the sediment, divided by that of water"},
    {law_members::of<Sediment, &Sediment::speed_ratio>, "speed_ratio", "", 0.5, 10, false, "speed_ratio", "", 1, false,
     true, "laws seabed and small_slope: sound speed of the sediment, divided by that of water"},
    {law_members::of<Sediment, &Sediment::loss>, "loss", "", 0, 0.1, true, "loss", "", 1, false, true,
     "laws seabed and small_slope: imaginary part of the wavenumber in the sediment, divided by its real part"},
    {law_members::of<Sediment, &Sediment::volume_parameter>, "volume_parameter", "", 0, 1, false, "volume_parameter",
     "", 1, false, true,
     "laws seabed and small_slope: volume scattering coefficient of the sediment, divided by its attenuation"},
    {law_members::of<Sediment, &Sediment::spectral_strength_cm4>, "spectral_strength_cm4", "cm^4", 0, 10, true,
     "spectral_strength_cm4", "cm^4", 1, false, true,
     "laws seabed and small_slope: strength of the spectrum of the relief at a wavenumber of 1/cm"},
    {law_members::of<Sediment, &Sediment::spectral_exponent>, "spectral_exponent", "", 2.1, 3.9, false,
     "spectral_exponent", "", 1, false, false,
     "laws seabed and small_slope: exponent by which the spectrum of the relief falls with the wavenumber"},
    {law_members::of<Sediment, &Sediment::grain_size>, "grain_size", "m", 0, 1, false, "grain_mm", "mm", 1e3, false,
     false,
     "laws seabed and small_slope: mean size of the grains. Frequencies above c / (pi grain size) count as that "
     "frequency; 0: the size is unknown, and no frequency is limited"},
    {law_members::of<RoughLaw, &RoughLaw::slope>, "slope", "", 0.02, 2, false, "slope", "", 1, false, true,
     "law rough: rms slope of the facets, both axes together; a smoother surface is a mirror"},
    {law_members::of<RoughLaw, &RoughLaw::micro_roughness>, "micro_roughness", "m", 0, 1, false, "micro_roughness_mm",
     "mm", 1e3, false, false, "law rough: rms height of the roughness that is finer than a facet"},
    {law_members::diffuse_mu, "diffuse_mu", "1/sr", 0, 1 / pi, false, "diffuse_mu_db", "dB re 1/sr", 1, true, false,
     "laws rough and ellis_crowe: Lambert coefficient of a diffuse echo that adds to that of the facets; default: no "
     "such echo (rough), -27 (ellis_crowe)"},
    {law_members::of<EllisCroweLaw, &EllisCroweLaw::facet_strength>, "facet_strength", "1/sr", 0, 1e3, false,
     "facet_strength_db", "dB re 1/sr", 1, true, true,
     "law ellis_crowe: backscattering strength of the facets at normal incidence"},
    {law_members::of<EllisCroweLaw, &EllisCroweLaw::facet_slope>, "facet_slope", "", 0.02, 1, false, "facet_slope", "",
     1, false, true, "law ellis_crowe: rms slope of the facets along one axis, 0.18 for 10 degrees"},
    {law_members::of<RoughLaw, &RoughLaw::reflection>, "reflection", "", 0, 1, false, "reflection", "", 1, false, false,
     "law rough: reflection coefficient of pressure, the same at all angles; give this key, or density and speeds"},
    {law_members::of<RoughLaw, &RoughLaw::density>, "density", "kg/m^3", 0, 3e4, false, "density", "kg/m^3", 1, false,
     false, "law rough: density of the solid; density and speeds give a reflection that depends on the angle"},
    {law_members::of<RoughLaw, &RoughLaw::compression_speed>, "compression_speed", "m/s", 0, 2e4, false,
     "compression_speed", "m/s", 1, false, false, "law rough: speed of compressional waves in the solid"},
    {law_members::of<RoughLaw, &RoughLaw::shear_speed>, "shear_speed", "m/s", 0, 1e4, false, "shear_speed", "m/s", 1,
     false, false, "law rough: speed of shear waves in the solid; 0: it is a fluid"},
};

/// Returns where a law is known to hold; everywhere for a law that does not say.
LawValidity validity_of(const SurfaceLaw& law, double frequency);

/// Returns `law` and the others that take its numbers: a sediment scatters by two laws.
std::vector<SurfaceLaw> laws_alike(const SurfaceLaw& law);

/// Returns the defect of an invalid law, e.g. "slope = 0.01, must be within 0.02 and 2"; empty for a valid law.
std::string problem_of(const SurfaceLaw& law);

/// Returns the law as one line of text, "rough slope=0.2 ..."; law_from_text reads it back to the same bits.
std::string law_to_text(const SurfaceLaw& law);
/// Returns the law that a text of law_to_text describes; nothing if the text is not a law with known numbers.
std::optional<SurfaceLaw> law_from_text(std::string_view text);

}  // namespace insonify
