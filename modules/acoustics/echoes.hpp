// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <cstddef>
#include <vector>

namespace insonify {

/// The complex factor xi of a scatterer's amplitude (E7).
enum class SurfaceAmplitude {
  complex_normal,  ///< Rayleigh speckle, bound to the scatterer id (E9)
  random_phase,    ///< unit amplitude, random phase
  coherent,        ///< 1: calibrated targets and closed forms
  mean_power       ///< 1 in water and boundaries too: for expected intensities, where phases do not count
};

/// Arrivals at the array, structure of arrays. A direct echo of scatterer i stands at index i.
struct Echoes {
  std::vector<double> delay;                    ///< [s], two way; absorption follows from its length
  std::vector<double> u;                        ///< direction cosine along the array (+port): cos(el) sin(az)
  std::vector<std::complex<double>> amplitude;  ///< [Pa], peak of the analytic signal before absorption; carries the
                                                ///< two-way carrier phase exp(2 i k r)
  std::vector<double> v{};        ///< direction cosine upwards, sin(el); empty: not needed, the head has one elevation
  std::vector<double> doppler{};  ///< shift of the carrier [Hz], positive when closing; empty: nothing moves

  /// Returns the number of echoes.
  std::size_t size() const { return delay.size(); }
  /// Returns the shift of echo i [Hz]; 0 if nothing moves.
  double doppler_of(std::size_t i) const { return doppler.empty() ? 0 : doppler[i]; }
};

}  // namespace insonify
