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

/// Draws densities [dB re 1 µPa²/Hz] against frequency [kHz] as a chart with a legend, the first one as a line and the
/// others dashed over it. min_db and max_db limit the level axis; by themselves they are the next multiples of 5 dB
/// beyond the highest and the lowest of all lines, at most window_db apart. See show_fan for files; Error(argument) unless there is a line, each of at least two points,
/// with finite ascending frequencies, as many densities, and none of them negative or NaN.
void show_spectrum(const std::vector<SpectrumLine>& lines, const PictureOptions& options, const std::string& png_path);

}  // namespace insonify
