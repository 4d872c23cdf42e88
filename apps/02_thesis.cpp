// SPDX-License-Identifier: BSD-3-Clause
// Reproduces figures 13 to 21 and Table 4 of A. Rascon's thesis (docs/results/thesis.md).
//   02_thesis FOLDER [--quick | --figures]
// --quick: small and coarse pictures, and run times of the smallest case only. --figures: no run times.
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "thesis/thesis.hpp"

int main(int argc, char** argv) {
  const std::string option = argc == 3 ? argv[2] : "";
  const bool quick = option == "--quick", figures_only = option == "--figures";
  if (argc < 2 || argc > 3 || argv[1][0] == '-' || (argc == 3 && !quick && !figures_only)) {
    std::cerr << "usage: 02_thesis FOLDER [--quick | --figures]\n";
    return 2;
  }
  try {
    insonify::thesis::FigureOptions figures;
    figures.folder = argv[1];
    if (quick) figures.width = 560, figures.height = 420, figures.bin_size = 5e-3;
    std::filesystem::create_directories(figures.folder);
    insonify::thesis::draw_figures(figures);
    if (quick)
      insonify::thesis::print_run_times({51}, 1);
    else if (!figures_only)
      insonify::thesis::print_run_times({51, 101, 256}, 9);
  } catch (const std::exception& error) {
    std::cerr << "02_thesis: " << error.what() << '\n';
    return 1;
  }
}
