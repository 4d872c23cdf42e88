#pragma once
#include <vector>

#include "beamforming/head_patterns.hpp"

namespace insonify {

/// What all beams of a head receive of a plane wave: the sum of the squared responses over beams (E10, E56), side lobes
/// included, from a table over u (within 1 % where a main lobe is, 5 % where side lobes alone are).
class ReceivedEnergy {
 public:
  /// With `half_width` > 0, means over u +- half_width instead.
  ReceivedEnergy(const SonarHead& head, double wavelength, double half_width = 0);
  double at(double u, double v);
  /// Of the array alone.
  double along_array(double u) const;

 private:
  std::vector<double> table_;  // over u from -1 to 1
  std::vector<RowResponse> rows_;
};

}  // namespace insonify
