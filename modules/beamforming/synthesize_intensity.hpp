#pragma once
#include "beamforming/synthesize.hpp"

namespace insonify {

/// Expected intensity per beam and range bin, beams x bins [Pa^2], of any head (E65): the mean of abs(P)^2 over echoes
/// with independent phases, that is, the image without its speckle:
///
///   I(b, n) = sum_i |A_i|^2 |B_b(u_i)|^2 |G_i(2 r_n / c - delay_i)|^2
///
/// |A_i|^2 is taken as it stands: give amplitudes of their mean power (SurfaceAmplitude::mean_power), not random ones.
/// Gaussian pulses: the gridded synthesis of a virtual head, for squares are such images themselves: |B|^2 is the pattern
/// of an array of 2N - 1 elements, weighted by the autocorrelation of the shading; |G|^2 is a Gaussian of sqrt(2) times
/// the bandwidth under twice the absorption, times sqrt(a_0 / a) exp(b^2 / 2a) for slope and curvature (a, b of E8).
/// Doppler shifts turn phases alone and change nothing. The error is below tolerance^2 (at least 1e-13) of the image's L2
/// norm: as far down in dB as that of a pressure image. Never below 0.
/// Sweeps: the direct sum, exact; cost echoes x beams x (elements + pulse samples).
/// Rows and columns as in synthesize. The result does not depend on options.threads. Throws Error as synthesize does, and
/// if beams x (2N - 1) elements exceed 2^28.
Grid<double> synthesize_intensity(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                  const SynthesisOptions& options = {});

struct LevelErrorOptions {
  double dynamic_range_db = 40;  ///< cells further below the strongest are not judged; within (0, 50]
  int threads = 0;               ///< 0: all cores; the result does not depend on it
};

/// Standard error of the expected level of every cell that comes from so few sample points, beams x bins [dB] (E66):
///
///   sigma = (10 / ln 10) sqrt(sum_i w_i^2) / sum_i w_i,   w_i = |A_i|^2 |B_b(u_i)|^2 |G_i(t_n)|^2
///
/// NaN where a cell is not judged: more than dynamic_range_db below the strongest one, or silent. It takes the points for
/// independent draws: their number in a cell is then a Poisson number, and 100 equal ones leave 0.43 dB. Stratified points
/// (split surfels, jittered rays) do better: an upper estimate for them. It cannot see what no point samples. Speckle is
/// not in it. First order in sigma: above about 2 dB only a sign that points are too few.
/// Amplitudes and sweeps as in synthesize_intensity, of which it costs two; the virtual head is one of 4N - 3 elements.
/// Within 2 % of the sums above. Throws Error as synthesize_intensity does, or for a dynamic range out of bounds.
Grid<float> predict_level_error_db(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                   const LevelErrorOptions& options = {});

}  // namespace insonify
