#pragma once
#include <string>

namespace insonify {

/// What a surface does to sound. The Lambert coefficient is the backscattering cross-section per unit area and
/// unit solid angle at normal incidence; energy conservation bounds it by 1/pi (-4.97 dB).
struct Material {
  std::string name = "default";
  double lambert_mu = 0.001995262314968880;  ///< [1/sr], -27 dB: Mackenzie (1961), the usual default for a sea bed
};

}  // namespace insonify
