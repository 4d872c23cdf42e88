#pragma once
#include <string>

#include "core/error.hpp"

namespace insonify {

/// What a surface does to sound. The Lambert coefficient is the backscattering cross-section per unit area and
/// unit solid angle at normal incidence; energy conservation bounds it by 1/pi (-4.97 dB).
struct Material {
  std::string name = "default";
  double lambert_mu = 0.001995262314968880;  ///< [1/sr], -27 dB: Mackenzie (1961), the usual default for a sea bed
  double coherent_fraction =
      0;                    ///< part of the mean intensity, in [0, 1], whose amplitude is 1 instead of random (E53)
  double relief_slope = 0;  ///< rms slope [rise over run] of relief finer than the surfels (E52); 0: smooth
};

/// Throws Error of `kind` unless lambert_mu and relief_slope are finite and >= 0 and coherent_fraction is in [0, 1].
void require_valid(const Material& material, const char* who, ErrorKind kind = ErrorKind::argument);

}  // namespace insonify
