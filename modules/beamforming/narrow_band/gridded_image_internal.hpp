#pragma once
#include "core/grid.hpp"

namespace insonify {

/// An image, and the fraction of the gridded energy that it contains.
struct GriddedImage {
  ComplexGrid pressure;  ///< beams x bins [Pa]
  /// Root of the mean energy per beam over that of all gridded pulses: 0.1 for a fan of 500 beams of which 5 receive an
  /// echo. Kernel errors are distributed evenly over all beams, so the smaller this fraction, the larger the relative
  /// error.
  double share = 0;
};

}  // namespace insonify
