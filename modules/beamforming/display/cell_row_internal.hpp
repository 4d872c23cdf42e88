// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "beamforming/display/display_plan_internal.hpp"
#include "beamforming/synthesize_cells.hpp"

namespace insonify {

/// An echo, as the cells of a row of beams take it.
struct CellEcho {
  double range, half_depth;                       ///< [m]
  double u, half_width;                           ///< in u
  double energy;                                  ///< of its surface, in a cell that holds all of it [Pa^2]
  std::complex<double> pressure;                  ///< root of its own energy in such a cell [Pa], with phase
  std::array<std::complex<double>, 2> amplitude;  ///< random, of mean power 1; of a fixed echo the first is 1
  double pieces = 1;                              ///< independent echoes that samples would have of it
  bool fixed = false;                             ///< its amplitude is not random
};

/// Deviations of a pulse's energy in range beyond which it is left out.
inline constexpr double reach_of_pulse = 4;

/// Samples about a period of u: one before it, and three behind.
inline constexpr std::size_t guards = 4;

/// The echoes of each cell: those of cell c are echo[first[c]] .. echo[first[c + 1] - 1].
struct EchoesByCell {
  std::vector<std::size_t> first;
  std::vector<std::uint32_t> echo;
};

/// Forms the cells of two neighbouring ranges at once, for all beams of a line array (E180); holds the memory for that.
class CellRow {
 public:
  /// Keeps references to all arguments, which must outlive it. element_noise: mean power at an element [Pa^2];
  /// first_element: number of its first element among those of the head.
  CellRow(const DisplayPlan& plan, std::span<const CellEcho> echoes, const EchoesByCell& lists,
          const CellOptions& options, double element_noise, std::size_t first_element);

  /// Writes the intensities of cell `cell` and, if there is one, of the next, to these columns of `image` (beams x
  /// cells).
  void form(std::size_t cell, Grid<double>& image);

 private:
  using Complex = std::complex<double>;

  /// An echo in a cell, with the part of its energy there.
  struct Part {
    const CellEcho* echo;
    double energy;  ///< [Pa^2]
    double field;   ///< the same, of an echo from its middle [Pa^2]
  };
  /// One of the two cells: its echoes, and the sums over them.
  struct Side {
    std::vector<Part> even, strong;  ///< echoes that are part of even ground, and those that are added as pressures
    double energy = 0;               ///< of all [Pa^2]
    double noise = 0;                ///< power of the noise in the fields of the beams [Pa^2]
    std::vector<double> mean;        ///< of each beam [Pa^2]
    std::vector<double> looks;       ///< of each broad node in use
    std::array<std::vector<Complex>, 2> field;       ///< of a period of u, with guards
    std::vector<std::vector<Complex>> strong_field;  ///< the same of strong echoes, by groups that interfere
    std::size_t groups = 0;
  };

  void list_parts(std::size_t cell, Side& side);
  void sum_means(std::size_t cell, std::size_t sides);
  void part_strong(Side& side);
  void sum_strong(Side& side);
  void add_strong(const Part& part, std::vector<Complex>& elements, std::vector<double>& mean) const;
  void sum_fields(std::size_t cell, Side& side);
  void sum_powers(std::size_t sides);
  void count_looks(std::size_t cell, Side& side);
  void add_noise(std::size_t cell, Side& side);
  void form_period(const Complex* elements, std::vector<Complex>& samples) const;
  /// Turns elements into samples of a period, and copies those at its ends to the guards.
  void transform_period(std::vector<Complex>& samples) const;
  double drawn(std::size_t beam, const Side& side, double power) const;

  const DisplayPlan& plan_;
  std::span<const CellEcho> echoes_;
  const EchoesByCell& lists_;
  const CellOptions& options_;
  double element_noise_;
  std::size_t first_element_;
  std::array<Side, 2> side_;
  std::vector<Complex> all_, all_samples_, power_;
  std::array<std::vector<Complex>, 2> nodes_;
  std::vector<float> energy_;
};

}  // namespace insonify
