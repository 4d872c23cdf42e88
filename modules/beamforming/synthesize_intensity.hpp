// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "beamforming/synthesize.hpp"

namespace insonify {

/// Returns the expected intensity per beam and range bin, beams x bins [Pa^2], of any head (E65): the mean of |P|^2
/// over echoes with independent phases, i.e. the image without speckle:
///
///   I(b, n) = sum_i |A_i|^2 |B_b(u_i)|^2 |G_i(2 r_n / c - delay_i)|^2
///
/// |A_i|^2 must be the mean power of each echo (SurfaceAmplitude::mean_power), not the power of a random amplitude.
///
/// Gaussian pulses: the squares have the form of an image, so a virtual head is synthesized by gridding. |B|^2 is the
/// pattern of an array of 2N - 1 elements weighted by the autocorrelation of the shading. |G|^2 is a Gaussian of
/// sqrt(2) times the bandwidth under twice the absorption, times sqrt(a_0 / a) exp(b^2 / 2a) for slope and curvature
/// (a, b of E8). Doppler shifts affect only phases and are ignored. The error is below tolerance^2 (at least 1e-13) of
/// the image's L2 norm; in dB this equals the error of a pressure image. Values are never below 0.
///
/// Sweeps: an exact direct sum at the cost of echoes x beams x (elements + pulse samples).
///
/// Rows and columns are treated as in synthesize. The result does not depend on options.threads. Throws Error as
/// synthesize does, and if beams x (2N - 1) elements exceed 2^28.
Grid<double> synthesize_intensity(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                  const SynthesisOptions& options = {});

}  // namespace insonify
