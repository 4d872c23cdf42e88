// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "acoustics/surface_scattering.hpp"
#include "scene/surface_law.hpp"

namespace insonify {

/// Backscattering cross-section per area of a sea bed [1/sr], in its two parts.
struct SeabedStrength {
  double diffuse = 0;  ///< relief by the composite-roughness model, and volume
  double lobe = 0;     ///< facets that face the sonar (Kirchhoff, or the large-roughness fit)
};

/// Returns the backscatter of a sea bed at `grazing` [rad] within 0 and pi/2 by APL-UW TR 9407 (1994), E139: roughness
/// by the composite model, Kirchhoff's integral near normal incidence, a fit for large roughness, and volume.
/// Reproduces the report's Table 3 within 0.10 dB but for four cells. For 10 to 100 kHz. Throws Error for an invalid
/// sediment, frequency [Hz] or sound speed [m/s].
SeabedStrength seabed_strength(const Sediment& sediment, double frequency, double sound_speed, double grazing);

/// Returns by how much law `seabed` (E140) is weaker straight back than TR 9407 (E139) [dB, >= 0]: its diffuse part is cut
/// at Lambert's limit, cos^2 / pi, since the report's rock would return more than it receives. Grazing angle [rad] within
/// 0 and pi/2. Within 0.15 dB of the law as it is computed, whose lobe loses to shadow and energy as well. Throws Error
/// as seabed_strength does.
double seabed_cut_db(const Sediment& sediment, double frequency, double sound_speed, double grazing);

/// Returns I(p) of the small-slope approximation: integral of J0(u) exp(-p u^(2 alpha)) u du over u > 0, for 0 < alpha
/// < 1, to 1e-5. As a mean over one-sided stable numbers (Kanter 1975), which does not oscillate; by its series where p
/// is small.
double small_slope_integral(double alpha, double p);

/// Returns the reflection coefficient of pressure off the solid (or, without shear speed, fluid) of a RoughLaw at
/// `cos_incidence` [m/s for the water's sound speed], E142; its `reflection` if it has no density. Water of 1026
/// kg/m^3.
std::complex<double> rough_reflection(const RoughLaw& law, double sound_speed, double cos_incidence);

/// Return the laws for sound of `frequency` [Hz] in water of `sound_speed` [m/s]. Throw Error for invalid laws and
/// numbers.
std::shared_ptr<const SurfaceScattering> lambert_surface(double lambert_mu);
/// TR 9407 with two directions (E140): diffuse part by the geometric mean of both, at most Lambert's 1/pi; lobe by the
/// facet half way, with the wavenumber across it.
std::shared_ptr<const SurfaceScattering> surface_of(const SeabedLaw& law, double frequency, double sound_speed);
/// Small-slope approximation of a fluid sediment (E141).
std::shared_ptr<const SurfaceScattering> surface_of(const SmallSlopeLaw& law, double frequency, double sound_speed);
/// Facets with micro-roughness (E142, E143).
std::shared_ptr<const SurfaceScattering> surface_of(const RoughLaw& law, double frequency, double sound_speed);
/// Ellis and Crowe's Lambert part and facets (E200).
std::shared_ptr<const SurfaceScattering> surface_of(const EllisCroweLaw& law, double frequency, double sound_speed);
/// Table (E144).
std::shared_ptr<const SurfaceScattering> surface_of(const TableLaw& law, double frequency, double sound_speed);

/// Returns the law of a material.
std::shared_ptr<const SurfaceScattering> surface_of(const Material& material, double frequency, double sound_speed);

/// Throws Error of `kind` if a surface scatters more power than it receives: albedo above 1.001 at one of ten
/// incidences, at frequencies of 10 kHz to 1 MHz and those of a table. Lambert's law may.
void require_energy(const Material& material, const char* who, ErrorKind kind = ErrorKind::argument);

/// Returns sentences on laws at `frequency` [Hz] in water of `sound_speed` [m/s]: for each material whose law is not
/// validated there, its possible error [dB]; for each bed whose law is cut by 0.5 dB or more (seabed_cut_db) at 5
/// degrees of grazing or above, by how much and where.
std::vector<std::string> surface_notes(std::span<const Material> materials, double frequency, double sound_speed);

}  // namespace insonify
