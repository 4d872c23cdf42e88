// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "sampling/find_scatterers.hpp"

namespace insonify {

/// The cells on a surface that a sampling resolves (E17). Between the ends of the main lobes, 1.5 widths and the
/// options' lobe_margin from the axis of a beam, they are resolution cells:
///
///   area = length width, width = range beam_width, length = min(dr / sin(incidence), 2 sqrt(2 range dr))
///
/// The second length is the extent of a plane at normal incidence within dr. For a planar array the cell is limited by
/// the cross-section of the beam: it is the smaller of range^2 beam_width row_width / cos_incidence and of length x
/// range x the narrower of both widths.
///
/// Beside the main lobes cells are wider, since a bin adds up the side-lobe echoes of all directions: at a distance d
/// from the end of the nearest main lobe, in u (for rows of a planar array in v), the width is range d / 2 if that is
/// more. Each doubling of d then holds equally many scatterers.
class SampledCells {
 public:
  /// Cells of a fan, as long as options.range_resolution [m], or two bins of the gate if that is 0.
  SampledCells(const BeamFan& fan, const RangeGate& gate, const SamplingOptions& options);

  /// Widths of a cell [rad].
  struct Widths {
    double beam;
    double row;  ///< 0: unlimited
  };
  /// Widths for a surface within `reach` [m] of `position` (head axes).
  Widths widths(const Eigen::Vector3d& position, double reach) const;
  /// Area of a cell of these widths [m^2].
  double area(double range, double cos_incidence, const Widths& widths) const;

  /// Returns the number of parts of a surfel at which a cell holds scatterers_per_cell: at least 1, not rounded; 1 if
  /// scatterers_per_cell is 0. The disc of the surfel lies about `position`; surface [m^2].
  double pieces(const Eigen::Vector3d& position, double surface, double cos_incidence) const;
  /// Returns the same for cells of these widths, as widths() returns them.
  double pieces(double range, double surface, double cos_incidence, const Widths& widths) const;

  /// Returns the number of parts of a surface that returns the fraction `share` of the energy of its cell (E127), not
  /// rounded. The surface needs all parts of its cells if the fraction is three tenths (fan) or an eighth (one beam).
  /// The number is infinite for cells of side lobes of a fan, since a bin adds up several of them.
  double pieces_of_share(double share, const Widths& widths) const;
  /// Width of a cell of shares, in u: a main lobe's; 2, which is all of u, for one beam.
  double width_of_shares() const { return one_beam_ ? 2 : main_lobe_.beam; }
  /// Returns the scatterers per resolution cell that the options ask for.
  double scatterers_per_cell() const { return scatterers_per_cell_; }
  /// Length of a cell along the line of sight [m].
  double range_resolution() const { return range_resolution_; }

 private:
  using Intervals = std::vector<std::pair<double, double>>;  // disjoint, ascending

  double scatterers_per_cell_, range_resolution_;
  Widths main_lobe_;
  bool one_beam_;
  Intervals lobes_u_, lobes_v_;
};

}  // namespace insonify
