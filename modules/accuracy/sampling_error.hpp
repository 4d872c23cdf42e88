// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace insonify {

/// Error of the mean level of a beam that comes from the sampling of a flat bottom, before any speckle.
struct SamplingErrorRow {
  std::string sampling;  ///< random-rays, jittered-rays (the product's), surfels, or split-surfels (of 60 000)
  double parameter = 0;  ///< rays per beam; surfels per m^2; scatterers wanted per resolution cell
  double scatterers_per_beam = 0;  ///< rays or scatterers that were made
  double error = 0;                ///< root mean square over beams and trials, relative, of the mean power
  double error_db = 0;             ///< error as a level: 10 log10(1 + error)
  double seconds = 0;              ///< time of sampling once, median over trials
};

/// Options of measure_sampling_error.
struct SamplingErrorOptions {
  int most_rays = 4096;  ///< per beam, in steps of four times from 16 on
  int trials = 4;        ///< seeds
  std::uint64_t seed = 1;
  int threads = 0;
};

/// Measures the error of the mean power in a strip of range 0.5 m long about 6 m, from a flat Lambert bottom 3 m below
/// the head, in 21 beams of 1 degree, against fine quadrature of the same integral: sum of sigma B^2 w(r) / r^4 (E4,
/// E10), w a Hann window.
std::vector<SamplingErrorRow> measure_sampling_error(const SamplingErrorOptions& options = {});

}  // namespace insonify
