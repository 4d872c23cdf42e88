#pragma once
#include <string>

namespace insonify::thesis {

struct FigureOptions {
  std::string folder;
  int width = 900, height = 675;  ///< of the charts [pixels]; images are five eighths of this
};

/// Writes figures 13 to 21 of the thesis, and three that explain them, as PNG files into the folder; prints the name of
/// each, and the numbers measured in them as rows of a markdown table.
void draw_figures(const FigureOptions& options);

}  // namespace insonify::thesis
