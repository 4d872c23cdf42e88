// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "beamforming/head_patterns.hpp"

namespace insonify {

/// What all beams of a head receive of a plane wave: the sum of the squared responses over beams (E10, E56), side lobes
/// included, from a table over u (within 1 % where a main lobe is, 5 % where side lobes alone are).
class ReceivedEnergy {
 public:
  /// With `half_width` > 0, means over u +- half_width instead; `over_band`: beams formed by true delays, whose
  /// response is that of each frequency of the pulse.
  ReceivedEnergy(const SonarHead& head, double wavelength, double half_width = 0, bool over_band = false);
  /// Returns the sum at direction cosines u along the array and v upwards.
  double at(double u, double v);
  /// Returns that of the array alone.
  double along_array(double u) const;

 private:
  /// Adds `part` of the response at elements `step` [rad] apart.
  void add_frequency(const SonarHead& head, double step, double half_width, double part);

  std::vector<double> table_;  // over u from -1 to 1
  std::vector<RowResponse> rows_;
};

}  // namespace insonify
