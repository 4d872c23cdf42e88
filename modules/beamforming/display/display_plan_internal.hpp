// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "beamforming/display/between_samples_internal.hpp"
#include "beamforming/display/cell_edges_internal.hpp"
#include "beamforming/display/looks_loops_internal.hpp"
#include "beamforming/display/pulse_energy_internal.hpp"
#include "beamforming/numerics/fft_internal.hpp"
#include "sonar/response_table.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

struct ReceiveFilter;

/// Deviations of a pulse's energy in range beyond which it is left out.
inline constexpr double reach_of_pulse = 4;

using kernels::field_parts;

/// Amplitudes with which an echo is in two neighbouring fields of a cell, of which `first` is the nearer, by its place in the
/// cell (E183): fields pass into each other over a third of the cell, and cells over twice `edge`.
struct FieldShares {
  struct Share {
    float near, far;
    std::uint32_t first;
  };
  FieldShares() = default;
  /// likeness   correlation of cells side by side
  explicit FieldShares(double likeness);
  double edge = 0;             ///< half the way from a cell to the next [cells]
  float per_cell = 0;          ///< steps of the table in a cell
  std::vector<Share> share{};  ///< amplitudes by place, from `edge` before a cell to `edge` behind it
};

/// Positions among samples of fields, and of powers. A period has four times as many samples as fields vary with, and
/// twice as many as powers, whose weak parts count: errors are below 1e-3 and 1e-6 of the root of the mean square. So
/// single precision is enough for fields.
using BetweenFields = Between<4, float>;
using BetweenPowers = Between<8>;

/// Where the beams of a row stand among the nodes and samples of a DisplayPlan.
struct BeamPositions {
  std::vector<double> u_beam;           ///< directions
  std::vector<std::int32_t> beam_near;  ///< the beam that receives each node best; -1: none has it in its lobe
  std::vector<double> broad_of;         ///< place of each beam among broad_used: index, and part of the way to the next
  std::vector<std::size_t> broad_used;  ///< every other broad node as far as beams go, ascending
  std::vector<BetweenFields> in_field;  ///< place of each beam among the samples of a field
  std::vector<BetweenPowers> in_power;  ///< place of each beam among the samples of powers of a period
  std::vector<BetweenPowers> in_all;    ///< place of each beam among the samples of all directions
};

/// Energy that a beam hears through grating lobes, by parts of the band and distances of broad nodes (E226). Empty where no
/// beam hears any.
struct GratingBands {
  std::size_t first = 0,
              count = 0;     ///< the least distance at which there is a lobe, and the number of them, in whole lanes
  std::size_t bands = 0;     ///< parts of the band, in whole lanes
  std::vector<float> heard;  ///< W of E181 of part q alone, at distance first + i: of index i bands + q
  std::vector<float> all, reversed;  ///< sums over the parts, for rising and for falling distances
  std::vector<float> alike;          ///< squared correlation of parts d apart, averaged over pairs of ranges of a cell
  std::vector<float> with_band;      ///< the same of each part with the whole band
};

/// Directions, patterns and transforms of the display cells of a line array, made once for many pings (E180).
///
/// Nodes of u are `node_width` wide, evenly over [-1, 1]: `nodes` in all, `period` of them in one period of the array's
/// response. Broad nodes of two hold the energies from which looks are counted.
struct DisplayPlan {
  /// The pulse is that of `head`; gate: cells. Samples, of which cells are the means, are `sample_length` [m] apart; 0:
  /// cells are integrals over range, with the noise of samples as usual. Throws Error for an invalid head or medium.
  DisplayPlan(const SonarHead& head, const Medium& medium, double sample_length);

  std::size_t nodes, period, broad;
  double node_width, nodes_per_u, beam_width;
  std::size_t node_of(double u) const {
    const double position = (u + 1) * nodes_per_u;
    return position <= 0 ? 0 : std::min(static_cast<std::size_t>(position), nodes - 1);
  }

  std::size_t all_length;

  std::vector<double> lag;                ///< R_m of E65 by lag, m = 0 .. N - 1, divided by N^2
  std::vector<double> lag_weight;         ///< the same, for samples that are interpolated (E186)
  std::vector<float> shared_weight;       ///< the same for samples that are interpolated as those of fields
  std::vector<float> element_weight;      ///< w_m / N, for samples that are interpolated (E186)
  std::size_t first_element;              ///< index of element 0 in a transformed period
  bool half_positions;                    ///< elements stand at half-integers
  std::vector<std::complex<float>> turn;  ///< factor of the pressure of an echo at each node, if half_positions

  std::vector<std::vector<double>> kernel;  ///< spectra of the band's mean pattern, by blocks of range
  /// Spectra of what of these patterns is heard one cell and two cells before an echo, and behind it (E188); empty if
  /// the array is short beside a cell.
  std::array<std::vector<std::vector<double>>, 2> kernel_beside;
  std::size_t kernel_of(std::size_t cell) const { return cell * kernel.size() / cells; }

  /// Returns the pattern averaged over the band, W of E181, at a distance in u.
  double mean_intensity(double offset) const {
    double mean = 0;
    for (const SpectrumNode& node : band_) mean += node.weight * response_at(offset * (1 + node.frequency));
    return mean;
  }

  std::vector<float> lobe;   ///< weights of broad nodes at distances 0, 1, .. within the main lobe
  double beside_lobe;        ///< mean response outside of it, up to the nearest grating lobe of the band
  std::size_t subranges;     ///< ranges of a cell whose energies are kept apart
  std::vector<float> looks;  ///< R_d of parts d apart (E182)
  GratingBands gratings;
  /// Correlation of ground less that of noise with ground, and less that of noise: means over pairs of ranges of a cell
  /// (E223).
  float noise_with_ground = 0, noise_alone = 0;
  double cycles_per_metre = 0;  ///< change of an echo's phase with range [1/m]
  FieldShares fields;
  double noise_of_next =
      0;  ///< part of the noise of a cell's last field that is that of the next, as an amplitude (E224)

  ResponseTable response;
  PulseEnergy pulse;
  CellEdges edges;
  double cell_length, first_range;
  std::size_t cells;

  Fft<double> to_elements, to_period, to_all, from_all;  ///< transform one array into another
  Fft<float> field_to_elements, elements_to_field;       ///< the same of fields

  /// Returns the positions of the beams of a fan of one elevation.
  BeamPositions positions_of(const BeamFan& fan) const;

 private:
  std::vector<SpectrumNode> band_;          // spectrum in the middle of the gate; frequencies over the carrier's
  double response_at(double offset) const;  // of any size
  /// Returns how far in u an echo may be from a beam.
  double farthest_of(const BeamFan& fan) const;
  /// Returns the same in nodes.
  std::size_t nodes_apart(const BeamFan& fan) const;
  /// Returns the least distance in u at which some part of the band has a grating lobe.
  double nearest_grating(const SonarHead& head) const;
  void fill_elements(const SonarHead& head);
  void fill_kernels(const SonarHead& head, const Medium& medium);
  /// Returns the spectrum of a pattern (by nodes apart) times `share` of it, as samples that are interpolated. Echoes are
  /// at most `farthest` nodes from a beam.
  std::vector<double> kernel_from(const std::vector<double>& pattern, const std::vector<double>& share,
                                  std::size_t farthest) const;
  void fill_lobe(const SonarHead& head);
  void fill_looks();
  void fill_gratings(const SonarHead& head);
  /// Sets the correlations of parts of the band of a width from `low` on, both over the carrier frequency; turns: its cycles
  /// between echoes of the ends of a cell.
  void correlate_parts(double low, double part, double turns);
  void fill_noise_looks(const ReceiveFilter& filter, double sample_length);
  void fill_neighbours();
};

}  // namespace insonify
