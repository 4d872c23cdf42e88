// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/surface_laws.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "acoustics/tabulated_surface_internal.hpp"
#include "core/error.hpp"
#include "core/require.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

class LambertSurface final : public SurfaceScattering {
 public:
  explicit LambertSurface(double mu) : mu_(mu) {}
  double cross_section(const PathAngles& path) const override {
    return path.cos_in > 0 && path.cos_out > 0 ? lambert_cross_section(mu_, path.cos_out, path.cos_in) : 0;
  }
  double per_seen_area(const PathAngles& path) const override { return lambert_cross_section(mu_, path.cos_out, 1); }
  double back(double cosine) const override { return lambert_cross_section(mu_, cosine, 1); }

 private:
  double mu_;
};

/// Returns the text of a note on a bed whose diffuse part is cut at Lambert's limit; empty if the cut is below 0.5 dB from
/// 5 degrees of grazing on.
std::string cut_note(const Sediment& bed, double frequency, double sound_speed) {
  constexpr double noted_db = 0.5;
  constexpr int least_deg = 5;
  const auto cut_db = [&](double deg) { return seabed_cut_db(bed, frequency, sound_speed, radians(deg)); };
  int to_deg = 90;
  while (to_deg >= least_deg && cut_db(to_deg) < noted_db) --to_deg;
  if (to_deg < least_deg) return "";

  std::ostringstream text;
  text << " stays below TR 9407, which returns more than arrives: at " << frequency * 1e-3 << " kHz by " << std::fixed
       << std::setprecision(1) << cut_db(10) << ", " << cut_db(20) << " and " << cut_db(45)
       << " dB at 10, 20 and 45 deg of grazing, and by " << noted_db << " dB or more up to " << to_deg << " deg";
  return text.str();
}

/// Returns the text of a note on a law that is not known at `frequency`; empty if it is known there.
std::string validity_note(const SurfaceLaw& law, double frequency) {
  const LawValidity v = validity_of(law, frequency);
  if (frequency >= v.least * (1 - 1e-9) && frequency <= v.most * (1 + 1e-9)) return "";

  std::ostringstream text;
  text << " is known from " << v.least * 1e-3 << " to " << v.most * 1e-3 << " kHz (" << v.source << "), not at "
       << frequency * 1e-3 << " kHz: its level may be off by " << v.error_db << " dB";
  return text.str();
}

}  // namespace

FluidBed::FluidBed(const Sediment& sediment, double frequency, double sound_speed, const char* who)
    : rho(sediment.density_ratio),
      nu(sediment.speed_ratio),
      delta(sediment.loss),
      sigma2(sediment.volume_parameter),
      w2(sediment.spectral_strength_cm4),
      gamma(sediment.spectral_exponent),
      alpha(0.5 * gamma - 1),
      kappa(1 / nu, delta / nu) {
  require_valid(SeabedLaw{sediment}, frequency, sound_speed, who);
  // Grains scatter as the frequency at which k grain / 2 = 1: what is above was never fitted.
  const double most = sediment.grain_size > 0 ? sound_speed / (pi * sediment.grain_size) : frequency;
  k = 2 * pi * std::min(frequency, most) / (100 * sound_speed);
  c = 2 * pi * w2 * std::tgamma(2 - alpha) * std::pow(2, -2 * alpha) / (alpha * (1 - alpha) * std::tgamma(1 + alpha));
}

void require_valid(const SurfaceLaw& law, double frequency, double sound_speed, const char* who) {
  require(frequency > 0 && std::isfinite(frequency), who, "frequency", frequency, "Hz", "finite and > 0");
  require(sound_speed > 0 && std::isfinite(sound_speed), who, "sound_speed", sound_speed, "m/s", "finite and > 0");
  if (const std::string problem = problem_of(law); !problem.empty())
    fail(ErrorKind::argument, who, ": law '", name_of(law), "': ", problem);
}

std::shared_ptr<const SurfaceScattering> lambert_surface(double lambert_mu) {
  return std::make_shared<const LambertSurface>(lambert_mu);
}

std::shared_ptr<const SurfaceScattering> surface_of(const Material& material, double frequency, double sound_speed) {
  return std::visit(
      [&](const auto& law) -> std::shared_ptr<const SurfaceScattering> {
        if constexpr (std::is_same_v<decltype(law), const LambertLaw&>)
          return lambert_surface(material.lambert_mu);
        else
          return surface_of(law, frequency, sound_speed);
      },
      material.law);
}

SurfaceTable surface_table(std::span<const Material> materials, double frequency, double sound_speed) {
  SurfaceTable table;
  std::vector<std::size_t> distinct;  // materials of laws that take time to tabulate, one of each
  for (const Material& m : materials) {
    const auto same = std::ranges::find_if(distinct, [&](std::size_t k) { return materials[k].law == m.law; });
    if (same != distinct.end()) {
      table.push_back(table[*same]);
      continue;
    }
    if (!std::holds_alternative<LambertLaw>(m.law)) distinct.push_back(table.size());
    table.push_back(surface_of(m, frequency, sound_speed));
  }
  return table;
}

void require_energy(const Material& material, const char* who, ErrorKind kind) {
  constexpr double most_albedo = 1.001, sound_speed = 1500;
  constexpr int incidences = 10;
  if (std::holds_alternative<LambertLaw>(material.law)) return;
  std::vector<double> frequencies = {10e3, 100e3, 1e6};
  if (const auto* table = std::get_if<TableLaw>(&material.law); table && !table->frequency.empty())
    frequencies = table->frequency;
  for (const double frequency : frequencies) {
    const auto surface = surface_of(material, frequency, sound_speed);
    for (int k = 0; k < incidences; ++k) {
      const double incidence = k * pi / (2 * incidences), share = albedo(*surface, std::cos(incidence));
      if (!(share <= most_albedo))
        fail(kind, who, ": material '", material.name, "' sends back ", share, " of the power that falls in at ",
             degrees(incidence), " deg and ", frequency * 1e-3, " kHz, must be at most 1; lower its numbers");
    }
  }
}

std::vector<std::string> surface_notes(std::span<const Material> materials, double frequency, double sound_speed) {
  std::vector<std::string> notes;
  for (const Material& m : materials) {
    std::vector<std::string> of_law = {validity_note(m.law, frequency)};
    if (const auto* bed = std::get_if<SeabedLaw>(&m.law)) of_law.push_back(cut_note(*bed, frequency, sound_speed));
    for (const std::string& text : of_law)
      if (!text.empty()) notes.push_back("material '" + m.name + "': law " + name_of(m.law) + text);
  }
  return notes;
}

}  // namespace insonify
