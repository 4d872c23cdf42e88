// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "beamforming/display/cell_row_internal.hpp"
#include "beamforming/synthesize_cells.hpp"
#include "sonar/beam_fan.hpp"

namespace insonify {

/// Responses of the beams of a row to the nodes of u in their main lobes and in their cells (E194), and which elevations
/// both hold.
struct LabelLobes {
  LabelLobes(const DisplayPlan& plan, const SonarHead& head, const std::vector<FanRow>& rows, std::size_t row,
             const std::vector<double>& u_beam);

  /// Nodes in the main lobe of a beam, and where their weights begin.
  struct Lobe {
    std::uint32_t first, count;
    std::size_t at;
  };
  std::vector<Lobe> of_beam;
  std::vector<float> lobe, cell;  ///< mean response to a node, times the part of it within the lobe and the cell

  /// Sines of elevations.
  struct Heights {
    double low = -2, high = 2;
  };
  Heights lobe_heights{}, cell_heights{};
};

/// A row of beams whose cells get labels: what they hear, the echoes and their elevations, and where the labels go.
struct LabelledRow {
  LabelLobes lobes;
  const EchoLabels& echoes;
  const std::vector<double>& sines;  ///< sines of elevations of the echoes of surfaces
  const std::vector<std::size_t>& beams;
  CellLabels& labels;
};

/// Finds the labels of the cells of a row, one after the other (E194, E195); holds the memory for that.
class LabelRow {
 public:
  /// Keeps references to all arguments, which must outlive it.
  LabelRow(const DisplayPlan& plan, const EchoesByCell& lists, const LabelledRow& row);

  /// Begins a cell.
  void start(std::size_t cell);
  /// Adds an echo with its energy in the cell [Pa^2].
  void add(const CellEcho& echo, double energy);
  /// Sets the labels of all beams in the cell. mean: what each receives of all surfaces and of noise [Pa^2].
  void finish(const std::vector<double>& mean, double noise);

  /// Returns true if an echo is of the water or a boundary.
  bool of_water(const CellEcho& echo) const {
    const std::size_t i = index_of(echo);
    return i >= row_.echoes.water_begin && i < row_.echoes.water_end;
  }

 private:
  /// The energies of one label, by nodes of u, which are 0 before `first` and after `last`.
  struct Sums {
    std::uint16_t label = 0;
    std::size_t first = std::numeric_limits<std::size_t>::max(), last = 0;
    std::vector<float> lobe, cell, strongest;
    std::vector<std::uint32_t> by;  ///< the echo that is the strongest
  };
  /// The energy of a label that a beam receives.
  struct Received {
    const Sums* of = nullptr;
    float cell = 0, lobe = 0;
  };

  /// Returns the number of an echo in the order in which echoes were given.
  std::size_t index_of(const CellEcho& echo) const { return lists_.source[&echo - lists_.echoes.data()]; }
  Sums& sums_of(std::uint16_t label);
  Received received_from(const Sums& sums, const LabelLobes::Lobe& lobe) const;
  std::uint32_t strongest_of(const Sums& sums, const LabelLobes::Lobe& lobe) const;
  void label_beam(std::size_t beam, double all);

  const DisplayPlan& plan_;
  const EchoesByCell& lists_;
  const LabelledRow& row_;
  std::size_t cell_ = 0;
  std::vector<Sums> sums_;
  std::size_t used_ = 0;              ///< number of sums_ in this cell
  std::vector<std::size_t> sums_at_;  ///< place of each label among them + 1; 0: it has none
};

}  // namespace insonify
