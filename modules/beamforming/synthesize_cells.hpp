// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "acoustics/echoes.hpp"
#include "core/grid.hpp"
#include "sonar/sonar_head.hpp"
#include "sonar/water.hpp"

namespace insonify {

/// The piece of surface that an echo is of, as a disc: by how much range [m] and u change from its middle to its edge, along
/// two axes at right angles that stand with the surface. All 0: a point.
struct EchoDisc {
  float range[2] = {0, 0}, u[2] = {0, 0};
  bool two_rings = false;  ///< true: it is drawn as two rings of four points; else as one
  /// Returns true if nothing changes from the middle to the edge.
  bool is_point() const { return range[0] == 0 && range[1] == 0 && u[0] == 0 && u[1] == 0; }
};

/// Echoes of random amplitude, and the pieces of surface that they stand for. One entry per echo in every array. A
/// surface may have several echoes, which carry its speckle; one of them has the energy of all. Both senses of a path
/// are two echoes of one id, which add up as pressures: an entry of id `of_both` behind them is what that adds to their
/// energy (E190), and has no pressure of its own.
struct SurfaceEchoes {
  static constexpr std::uint64_t of_both = 0xffffffffffffffff;

  Echoes echoes;                  ///< roots of the mean power, with the phase of the carrier (mean_power)
  std::vector<std::uint64_t> id;  ///< number from which the random amplitude follows, as RandomCounter::first
  std::vector<double> power;      ///< mean power of all echoes of the surface [Pa^2]; 0: another echo has it
  std::vector<float> depth;       ///< half extent of the whole surface along the line of sight [m]
  std::vector<float> width;       ///< half extent of the whole surface in u
  /// How u changes along a tilted surface with range [1/m], and its half extent in u at one range, of the first echoes
  /// (E189); the others are as wide at each of their ranges.
  std::vector<float> slope{}, across{};
  std::vector<EchoDisc> disc{};  ///< discs of the first echoes, which carry their speckle (E228); the others are points
};

/// Options of synthesize_cells.
struct CellOptions {
  std::uint64_t seed = 1;
  std::int64_t ping = 0;  ///< number of the ping; every ping has its own noise
  /// Level of the noise of an element in the pulse's band [dB re 1 uPa rms]; -inf: none.
  double element_noise_db = -std::numeric_limits<double>::infinity();
  bool speckle = true;  ///< false: the expected intensity
  int threads = 0;      ///< 0: all cores; the result does not depend on it
};

/// Labels of the surfaces that echoes are of.
struct EchoLabels {
  std::vector<std::uint16_t> label;            ///< one for each of the first echoes of surfaces
  std::size_t water_begin = 0, water_end = 0;  ///< echoes of water and boundaries, of which no cell has a share
};

/// The labels of display cells, beams x cells.
struct CellLabels {
  static constexpr std::uint16_t none = 0xffff;
  static constexpr std::uint32_t no_echo = 0xffffffff;

  Grid<std::uint16_t> label, second;  ///< `none` where no echo with a label is, or no other label
  Grid<float> share, second_share;    ///< parts of the energy of all echoes of surfaces; 0 without a label
  Grid<std::uint32_t> echo;           ///< the strongest echo of that label in the cell; no_echo without a label
};

/// Returns the intensity of display cells, beams x cells [Pa^2]: of each the mean of |P|^2 over the area between its
/// ranges, without forming P (E180). head.gate holds the cells.
///
/// The expected intensity is the sum of the energies of the echoes, times the pattern of the beam, averaged over the
/// band (E181). The number of looks of a cell follows from the ranges of its energy, from the pulse and from the noise
/// (E182, E223, E226). Speckle is a gamma variate of so many looks (E229), made from three complex sums over the echoes of
/// thirds of its ranges, with their phases and random amplitudes: it stays with the surface and changes with the pose like
/// speckle of samples (E183, E228). Pressures are added of echoes that hold more than a tenth of a cell (E184) and of
/// `fixed` ones, whose amplitudes are not random.
///
/// Accuracy against cells of true_delays samples (docs/results/display.md): bands of range 0.05 dB, cells 0.3 dB rms in the
/// mean; contrast 5 %. Doppler shifts are ignored. Throws Error for an
/// invalid head or medium, for arrays of different lengths, and for a head with several rows or a column unless
/// echoes.v has one entry per echo.
Grid<double> synthesize_cells(const SurfaceEchoes& surface, const Echoes& fixed, const SonarHead& head,
                              const Medium& medium, const CellOptions& options = {});

/// A synthesize_cells for many pings of one head, whose patterns and transforms are made once. Several threads may
/// call.
class CellSynthesizer {
 public:
  /// Keeps what all pings share. `sample_length` is the distance in range [m] of the samples whose means the cells stand
  /// for (E227); the correlation of noise depends on it (E223). 0: cells are integrals over range, with the noise of samples
  /// at default_bin_size. Throws Error for an invalid head or medium, or a length < 0.
  CellSynthesizer(const SonarHead& head, const Medium& medium, double sample_length = 0);
  ~CellSynthesizer();
  CellSynthesizer(CellSynthesizer&&) noexcept;

  /// Returns what synthesize_cells returns, to the byte. Throws Error as that does.
  Grid<double> cells(const SurfaceEchoes& surface, const Echoes& fixed, const CellOptions& options = {}) const;

  /// Returns the same, and sets the labels of cells from expected energies (E194, E195).
  ///
  /// The label of a cell is that with the most energy of echoes from directions within the half-power width of the beam
  /// and ranges within the cell and half a pulse; at least one beam's step wide, and for several rows also high. Its
  /// share is the energy that comes from a whole width to either side, the main lobe, over that of all echoes but those
  /// of water and boundaries, noise excluded. The second label is the one with the most such energy among the others.
  Grid<double> cells(const SurfaceEchoes& surface, const Echoes& fixed, const CellOptions& options,
                     const EchoLabels& labels, CellLabels& shown) const;

 private:
  struct Plan;
  Grid<double> formed(const SurfaceEchoes& surface, const Echoes& fixed, const CellOptions& options,
                      const EchoLabels* labels, CellLabels* shown) const;

  std::unique_ptr<const Plan> plan_;
};

}  // namespace insonify
