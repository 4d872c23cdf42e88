#pragma once
#include <string>
#include <vector>

#include "view/picture.hpp"

namespace insonify {

/// A power spectral density to be drawn.
struct SpectrumLine {
  std::vector<double> frequency;  ///< [Hz], ascending
  std::vector<double> density;    ///< [Pa^2/Hz]
  std::string name;               ///< in the legend
};

/// Draws densities [dB re 1 µPa²/Hz] against frequency [kHz] as a chart with a legend, the first one as a solid line
/// and the others dashed over it. min_db and max_db limit the level axis; defaults are the next multiples of 5 dB
/// beyond the extremes of all lines, at most window_db apart. Files as show_fan; Error(argument) unless there is at
/// least one line, each with at least two points, finite ascending frequencies, as many densities, and none of them
/// negative or NaN.
void show_spectrum(const std::vector<SpectrumLine>& lines, const PictureOptions& options, const std::string& png_path);

}  // namespace insonify
