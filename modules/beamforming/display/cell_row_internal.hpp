// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

#include "beamforming/display/display_plan_internal.hpp"
#include "beamforming/display/looks_loops_internal.hpp"
#include "beamforming/synthesize_cells.hpp"
#include "core/uninitialized_vector.hpp"

namespace insonify {

/// An echo, as the cells of all rows of beams take it, at the peak of their responses: in single precision, so that it
/// is less than one line of the cache.
struct CellEcho {
  float range, half_depth;        ///< [m]
  float u;                        ///< direction cosine of its middle
  float half_width;               ///< in u
  float slope, across;            ///< change of u with range [1/m], half width at one range (E189)
  float reach;                    ///< half length of its surface and of a pulse together [m]
  float per_node;                 ///< 1 over the number of broad nodes that it is in
  float energy;                   ///< energy of its surface in a cell that holds all of it [Pa^2]
  float together;                 ///< energy of all echoes of its amplitude, which add as pressures, in its own; 0: its
                                  ///< amplitude is not random
  float re, im;                   ///< its phase, times the random amplitude that samples have (E9), if any
  std::uint32_t port, starboard;  ///< broad nodes of its ends

  std::complex<float> pressure() const { return {re, im}; }
  void set_pressure(const std::complex<float>& pressure) { re = pressure.real(), im = pressure.imag(); }
};
static_assert(sizeof(CellEcho) <= 64);
// Else an UninitializedVector would set them all.
static_assert(std::is_trivially_default_constructible_v<CellEcho>);

/// Returns the length of the overlap of [low, high] with [first, last].
inline double overlap(double low, double high, double first, double last) {
  return std::max(0.0, std::min(high, last) - std::max(low, first));
}

/// An echo in a cell.
struct EchoInCell {
  std::uint32_t echo;
  float energy;  ///< its surface's energy there, at the peak of the responses of rows [Pa^2]
};

/// A point of the surface of an echo, as the fields of a cell take it (E183).
struct FieldPoint {
  float re, im;         ///< pressure at the middle of the array [Pa]
  float power;          ///< expected square of the pressure [Pa^2]
  std::uint32_t node;   ///< number of its node in a period of u
  std::uint32_t share;  ///< index in DisplayPlan::fields of its place in the cell
  std::uint32_t echo;   ///< number of its echo
};
static_assert(std::is_trivially_default_constructible_v<FieldPoint>);
/// The points of each cell: those of cell c are point[first[c]] .. point[first[c + 1] - 1].
struct PointsByCell {
  std::vector<std::size_t> first;
  UninitializedVector<FieldPoint> point;
};

/// The echoes of each cell: those of cell c are piece[first[c]] .. piece[first[c + 1] - 1].
struct EchoesByCell {
  PointsByCell points;
  UninitializedVector<CellEcho> echoes;       ///< those that are in a cell, by their first cells
  UninitializedVector<std::uint32_t> source;  ///< number of each echo here among those of the surface, then those fixed
  std::vector<std::size_t> first;
  UninitializedVector<EchoInCell> piece;
};

struct LabelledRow;
class LabelRow;

/// The echoes that a row of beams receives: its response to each echo, 0 where it receives nothing; empty: 1. Its beams, its
/// first element's number among those of the head, and the mean noise power at one of its elements [Pa^2].
struct RowReception {
  BeamPositions beams;
  std::vector<double> response;
  std::size_t first_element = 0;
  double element_noise = 0;
  const LabelledRow* labelled = nullptr;  ///< where its cells get labels; nullptr: they get none
};

/// Forms the cells of two neighbouring ranges at once, for all beams of a line array (E180); holds the memory for that.
class CellRow {
 public:
  /// Keeps references to all arguments, which must outlive it.
  CellRow(const DisplayPlan& plan, const EchoesByCell& lists, const RowReception& row, const CellOptions& options);
  ~CellRow();

  /// Writes the intensities of cell `cell` and, if there is one, of the next, to these columns of `image` (beams x cells), and
  /// to the rows that `beams` lists.
  void form(std::size_t cell, const std::vector<std::size_t>& beams, Grid<double>& image);

 private:
  using Complex = std::complex<double>;
  using Field = std::vector<std::complex<float>>;

  /// An echo in a cell, with the part of its energy there.
  struct Piece {
    const CellEcho* echo;
    float energy;  ///< [Pa^2]
    float response;
  };
  /// One of the two cells: its echoes, and the sums over them.
  struct Side {
    std::vector<Piece> even, strong;  ///< echoes that are part of even ground, and those that are added as pressures
    std::vector<std::uint32_t> strong_numbers;           ///< numbers of strong echoes of random amplitude, ascending
    double energy = 0;                                   ///< energy of all echoes [Pa^2]
    double noise = 0;                                    ///< power of the noise in the fields of the beams [Pa^2]
    std::vector<double> mean;                            ///< expected intensity of each beam [Pa^2]
    std::vector<double> looks;                           ///< number of looks at each broad node in use (E182)
    std::array<Field, field_parts> field;                ///< sums over echoes at a period of u, with guards (E183)
    std::array<std::vector<double>, field_parts> power;  ///< their expected power in each beam [Pa^2]
    std::array<std::vector<double>, field_parts - 1> shared;  ///< expected product of each with the next [Pa^2]
    std::vector<Field> strong_field;                          ///< field of the strong echoes, by groups that interfere
    std::size_t groups = 0;
  };

  /// Energies of two cells by nodes of u, as real and imaginary parts. Nodes are counted from 1.
  struct Densities {
    std::size_t cell = std::numeric_limits<std::size_t>::max();  ///< the first
    bool with_water = false;
    std::vector<Complex> at;
  };

  void list_pieces(std::size_t cell, Side& side);
  /// Returns the energies of cells `cell`, which is even, and `cell` + 1. Those of three neighbouring pairs are kept.
  std::vector<Complex>& densities(std::size_t cell, bool with_water);
  /// Adds the energy of an echo in the cell between two edges to the differences of nodes; `at`: every other number is of
  /// a node.
  void add_surface(const CellEcho& echo, double energy, const CellEdges::Edge& near, const CellEdges::Edge& far,
                   double* at) const;
  /// Returns the half length [nodes] of the box of an energy with the square of a half width in u.
  double half_of_box(double square) const;
  /// Adds energy evenly over a box about u of a half length [nodes]; `at`: every other number is of a node.
  void add_box(double u, double half, double energy, double* at) const;
  /// Adds what beams hear of the cells before and behind to spectrum_ (E188).
  void add_cells_beside(std::size_t cell, bool with_water);
  void sum_means(std::size_t cell, bool with_water = true);
  /// Returns the mean energy of an echo in a beam, over its extent in u, at the centre frequency [Pa^2].
  double heard_of(const Piece& piece, std::size_t beam) const;
  void form_means(std::size_t cell, std::size_t sides);
  void label(std::size_t cell, Side& side);
  void partition_strong(Side& side);
  void sum_strong(Side& side);
  void add_strong(const Piece& piece, std::vector<double>& mean);
  void sum_fields(std::size_t cell, std::size_t s);
  void sum_powers(std::size_t sides);
  /// Sums up what field q shares with the next, in beams of both cells.
  void sum_shared(std::size_t q);
  /// Lists the energies of even ground in a cell by broad nodes, over `unit` [Pa^2].
  void list_energies(std::size_t cell, const Side& side, double unit);
  void count_looks(std::size_t cell, Side& side);
  /// Adds noise of a power [Pa^2] in the beams to the pressures of field q in at_elements_.
  void add_noise(std::size_t cell, std::size_t q, double noise);
  void add_noise_of(std::size_t cell, std::size_t q, double amplitude);
  /// Turns pressures in at_elements_, from first_element on, into samples of their field.
  void form_field(Field& samples);
  void draw(Side& side);
  void add_groups(std::size_t beam, Side& side);

  const DisplayPlan& plan_;
  const EchoesByCell& lists_;
  const RowReception& row_;
  const BeamPositions& beams_;
  const CellOptions& options_;
  std::array<Side, 2> side_;
  std::array<Densities, 3> densities_;
  std::vector<Complex> all_, spectrum_, beside_,
      all_samples_;                                         ///< energies of cells over u, and those that beams receive
  std::array<std::vector<Complex>, field_parts> power_at_;  ///< powers of the fields by nodes, likewise
  std::array<Field, field_parts - 1> shared_at_;            ///< products of each field with the next by nodes, likewise
  Field shared_;                                            ///< one of them over a period of u
  std::vector<Complex> lags_, power_;                       ///< those of one part over a period of u
  std::vector<Complex> elements_;                           ///< spectrum of the powers of one part
  Field at_elements_, weighted_;                            ///< pressures at elements; the same weighted, 0 elsewhere
  std::array<Field, field_parts> nodes_;                    ///< pressures of echoes by nodes
  std::vector<float> energy_, alike_;                       ///< energies of broad nodes (kernels::CellEnergies)
  std::vector<float> whole_;  ///< the same over all ranges; empty where no grating lobe is heard
  std::vector<kernels::RangedEnergy> ranged_;
  std::vector<std::uint64_t> noise_id_;
  std::vector<double> noise_re_, noise_im_;
  /// Even ground as each beam receives it (kernels::EvenGround).
  struct {
    std::array<std::vector<double>, field_parts> intensity;
    std::vector<double> looks, mean, strong;
  } even_;
  std::vector<double> drawn_;
  std::unique_ptr<LabelRow> labels_;
};

}  // namespace insonify
