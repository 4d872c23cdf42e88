#pragma once
#include <complex>
#include <string>
#include <vector>

#include "sampling/scatterers.hpp"

namespace insonify {

/// Scatterers from another program: positions, cross-sections and complex amplitudes.
struct ScattererTable {
  Scatterers scatterers;                 ///< range, azimuth, elevation, id = line order
  std::vector<double> sigma;             ///< backscattering cross-section [m^2]
  std::vector<std::complex<double>> xi;  ///< random amplitude, E|xi|^2 = 1
};

/// Reads CSV with the header range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im in any order; '#' starts
/// a comment line. Throws Error(file), or Error(content) with path, line, column name and rule.
ScattererTable load_scatterer_table(const std::string& path);

}  // namespace insonify
