// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <cstdint>
#include <span>

#include "acoustics/transmission.hpp"
#include "sampling/scatterers.hpp"

namespace insonify {

/// Returns the two-way pressure response of the head at `elevation` [rad], by shape, width and centre of `options`
/// (E14); 1 without a pattern.
double elevation_pattern(const EchoOptions& options, double elevation);

/// Returns the one-way pressure response of the transmitter at any `azimuth` [rad], a Gaussian lobe about azimuth 0
/// (E57); 1 without a pattern.
double transmit_pattern(const EchoOptions& options, double azimuth);

/// Returns the direct echo of every scatterer (E7): amplitude = sqrt2 p0 xi sqrt(sigma) b_E b_T exp(2 i k_c r) / r^2
/// [Pa], with sigma the cross_section of the material's law, b_E the elevation pattern and b_T the transmitter's in
/// azimuth.
///
/// materials   looked up by scatterers.material
/// returns     one echo per scatterer, in order; delay = 2 r / c. The phase is reduced to one cycle in double.
///
/// Unless all amplitudes are coherent, a material's coherent_fraction g makes them Rician about 1 (E53):
/// xi = sqrt(g) + sqrt(1 - g) z, z the random amplitude of options.amplitude; mean power 1.
///
/// Throws Error for an invalid pulse, medium, material or material index, and for a range that is not > 0.
Echoes direct_echoes(const Scatterers& scatterers, std::span<const Material> materials, const Transmission& sent);
/// Returns the same, for a transmission without a table of surfaces.
Echoes direct_echoes(const Scatterers& scatterers, std::span<const Material> materials, const Pulse& pulse,
                     const Medium& medium, const EchoOptions& options = {});

/// Returns the same for targets with known cross-sections sigma [m^2] and amplitudes xi (calibrated targets, other
/// simulators' scatterers): only range, azimuth and elevation of `scatterers` are used.
Echoes target_echoes(const Scatterers& scatterers, std::span<const double> sigma,
                     std::span<const std::complex<double>> xi, const Pulse& pulse, const Medium& medium,
                     const EchoOptions& options = {});

/// Sets `re` and `im` (arrays as long as `id`) to the complex normal amplitudes of scatterers, of mean power 1, by seed
/// and scatterer id (E9): those of direct_echoes with SurfaceAmplitude::complex_normal.
void random_amplitudes(std::uint64_t seed, std::span<const std::uint64_t> id, double* re, double* im);

}  // namespace insonify
