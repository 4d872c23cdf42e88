#pragma once
#include "beamforming/synthesize.hpp"

namespace insonify {

/// Returns the expected intensity per beam and range bin, beams x bins [Pa^2], of any head (E65): the mean of |P|^2
/// over echoes with independent phases, i.e. the image without its speckle:
///
///   I(b, n) = sum_i |A_i|^2 |B_b(u_i)|^2 |G_i(2 r_n / c - delay_i)|^2
///
/// |A_i|^2 must be the mean power of each echo (SurfaceAmplitude::mean_power), not that of a random amplitude. Gaussian
/// pulses: gridded synthesis of a virtual head, since the squares have the form of an image: |B|^2 is the pattern of an
/// array of 2N - 1 elements weighted by the autocorrelation of the shading; |G|^2 is a Gaussian of sqrt(2) times the
/// bandwidth under twice the absorption, times sqrt(a_0 / a) exp(b^2 / 2a) for slope and curvature (a, b of E8).
/// Doppler shifts affect phases only and are ignored. The error is below tolerance^2 (at least 1e-13) of the image's L2
/// norm, the same in dB as that of a pressure image. Values are never below 0. Sweeps: direct sum, exact; cost echoes x
/// beams x (elements + pulse samples). Rows and columns are treated as in synthesize. The result does not depend on
/// options.threads. Throws Error as synthesize does, and if beams x (2N - 1) elements exceed 2^28.
Grid<double> synthesize_intensity(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                  const SynthesisOptions& options = {});

/// Options of predict_level_error_db.
struct LevelErrorOptions {
  double dynamic_range_db = 40;  ///< cells further below the strongest one are NaN; within (0, 50]
  int threads = 0;               ///< 0: all cores; the result does not depend on it
};

/// Returns the standard error of the expected level due to the finite number of sample points, beams x bins [dB] (E66):
///
///   sigma = (10 / ln 10) sqrt(sum_i w_i^2) / sum_i w_i,   w_i = |A_i|^2 |B_b(u_i)|^2 |G_i(t_n)|^2
///
/// NaN for cells that are silent or more than dynamic_range_db below the strongest one. Assumes independent points,
/// whose number in a cell is Poisson distributed: 100 equal ones give 0.43 dB. For stratified points (split surfels,
/// jittered rays) it is an upper estimate. It does not include surfaces that no point samples, nor speckle. First order
/// in sigma: values above about 2 dB only indicate that points are too few. Amplitudes and sweeps as in
/// synthesize_intensity, at twice its cost; the virtual head has 4N - 3 elements. Accurate to 2 % of the sums above.
/// Throws Error as synthesize_intensity does, or for a dynamic range out of bounds.
Grid<float> predict_level_error_db(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                   const LevelErrorOptions& options = {});

}  // namespace insonify
