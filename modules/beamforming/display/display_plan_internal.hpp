// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "beamforming/display/pulse_energy_internal.hpp"
#include "beamforming/numerics/fft_internal.hpp"
#include "sonar/response_table.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// A position between four neighbouring samples, and their weights (cubic interpolation).
struct BetweenFour {
  std::size_t first;
  std::array<double, 4> weight;
  template <typename Number>
  Number of(const Number* samples) const {
    return weight[0] * samples[first] + weight[1] * samples[first + 1] + weight[2] * samples[first + 2] +
           weight[3] * samples[first + 3];
  }
};

/// Where the beams of a row stand among the nodes and samples of a DisplayPlan.
struct BeamPositions {
  std::vector<double> u_beam;           ///< directions
  std::vector<std::int32_t> beam_near;  ///< the beam that receives each node best; -1: none has it in its lobe
  std::vector<double> broad_of;         ///< place of each beam among broad_used: index, and part of the way to the next
  std::vector<std::size_t> broad_used;  ///< every other broad node as far as beams go, ascending
  std::vector<BetweenFour> in_period;   ///< place of each beam among the samples of a transformed period
  std::vector<BetweenFour> in_all;      ///< place of each beam among the samples of all directions
};

/// Directions, patterns and transforms of the display cells of a line array, made once for many pings (E180).
///
/// Nodes of u are `node_width` wide, evenly over [-1, 1]: `nodes` in all, `period` of them in one period of the array's
/// response. Broad nodes of two hold the energies from which looks are counted.
struct DisplayPlan {
  /// The pulse is that of `head`; gate: cells. Throws Error for an invalid head or medium.
  DisplayPlan(const SonarHead& head, const Medium& medium);

  std::size_t nodes, period, broad;
  double node_width, beam_width;
  std::size_t node_of(double u) const {
    const double position = (u + 1) / node_width;
    return position <= 0 ? 0 : std::min(static_cast<std::size_t>(position), nodes - 1);
  }

  std::size_t period_samples, all_length, all_samples;

  std::vector<double> lag;                 ///< R_m of E65 by lag, m = 0 .. N - 1, divided by N^2
  std::vector<double> shading;             ///< w_m / N
  std::size_t first_element;               ///< index of element 0 in a transformed period
  bool half_positions;                     ///< elements stand at half-integers
  std::vector<std::complex<double>> turn;  ///< factor of the pressure of an echo at each node, if half_positions

  std::vector<std::vector<double>> kernel;  ///< spectra of the band's mean pattern, by blocks of range
  std::size_t kernel_of(std::size_t cell) const { return cell * kernel.size() / cells; }

  std::vector<float> lobe;   ///< weights of broad nodes at distances 0, 1, .. within the main lobe
  double beside_lobe;        ///< mean response outside of it
  std::size_t subranges;     ///< ranges of a cell whose energies are kept apart
  std::vector<float> looks;  ///< R_d of parts d apart (E182)

  ResponseTable response;
  PulseEnergy pulse;
  double cell_length, first_range;
  std::size_t cells;

  Fft<double> to_elements, to_period, to_all, from_all;

  /// Returns the positions of the beams of a fan of one elevation.
  BeamPositions positions_of(const BeamFan& fan) const;

 private:
  double response_at(double offset) const;  // of any size
  void fill_kernels(const SonarHead& head, const Medium& medium);
  void fill_looks(const SonarHead& head);
};

}  // namespace insonify
