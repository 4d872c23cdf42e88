// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "beamforming/head_patterns.hpp"

namespace insonify {

class ReceiveArray;

/// Table of the energy that all beams of a head together receive from a plane wave: the sum over beams of the squared
/// response, side lobes included (E10, E56). Interpolation over u and v is accurate to 1 % within a main lobe and to 5 %
/// where only side lobes receive. For an array that is no line the entries are those at the elevation of its beams.
class ReceivedEnergy {
 public:
  /// Tabulates the sum at `wavelength` [m]. If `half_width` > 0, each entry is the mean over u +- half_width. If
  /// `over_band`, each entry is the mean over the frequencies of the pulse, as for beams formed with true delays.
  ReceivedEnergy(const SonarHead& head, double wavelength, double half_width = 0, bool over_band = false);
  /// Returns the sum at direction cosines u along the array and v upwards.
  double at(double u, double v) const;
  /// Returns the sum for the array alone, without elevation patterns.
  double along_array(double u) const;

 private:
  /// Adds the squared response of elements `step` [rad] apart in phase, times `share`.
  void add_frequency(const SonarHead& head, double step, double half_width, double share);
  void add_responses(const ReceiveArray& array, const BeamFan& fan, double wavelength, double half_width, double share);

  std::vector<double> table_;  // over u from -1 to 1
  std::vector<double> rows_;   // sum over rows of their squared responses, over v from -1 to 1; empty: 1
};

}  // namespace insonify
