// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <deque>
#include <memory>
#include <vector>

#include "beamforming/numerics/lazy_internal.hpp"
#include "beamforming/true_delays/beam_table_internal.hpp"
#include "beamforming/true_delays/echo_feed_internal.hpp"
#include "core/grid.hpp"

namespace insonify {

/// The tables of one part of the array for all ranges from `nearest` on. Each is made when it is first used.
class BeamTables {
 public:
  /// `nearest` [bins of the gate].
  BeamTables(BeamTableSizes sizes, double nearest);

  /// Returns the first bin of each table, then the end of the last table.
  const std::vector<double>& edges() const { return edge_; }
  /// Returns the table that covers a bin: the last one that begins at or before it. `shifted` selects the table for the
  /// Doppler shift BeamTableSizes::shifted.
  const BeamTable& at(double bin, bool shifted) const;
  /// Returns the number of bins by which responses extend beyond their echoes on either side.
  double guard() const { return guard_; }
  /// Samples of pulses that all tables sum, and their size [bytes].
  double work() const { return work_; }
  double bytes() const { return bytes_; }

 private:
  BeamTableSizes sizes_;
  std::vector<double> edge_;
  std::vector<BeamTableSizes::Span> span_;
  std::deque<Lazy<BeamTable>> table_, shifted_;
  double guard_ = 0, work_ = 0, bytes_ = 0;
};

/// Image of one beam with true delays, focused at every range (E61, E62): a sum of responses read from tables (E134).
/// For an echo far beyond the main lobe, the contributions between the ends of the array cancel, so two tables of the
/// ends give the response. The cost of an echo depends neither on the number of elements nor on the number of
/// directions.
class OneBeam {
 public:
  /// Returns nullptr if the head has several beams or a sweep, or if its tables cost more than they are worth.
  /// `widest`: |u| of echoes.
  static std::unique_ptr<const OneBeam> make(const SonarHead& head, const Medium& medium, double tolerance,
                                             double widest);

  /// Returns the stretches of time: first the ranges that are too near for tables, then stretches of at most 256 bins.
  const TimeStretches& stretches() const { return stretches_; }
  /// Adds the echoes of all stretches but the first to the image of 1 x bins [Pa]. The bits do not depend on `threads`.
  /// Doppler shifts must be within most_shifted of the carrier.
  void add_image(const EchoFeed& feed, int threads, ComplexGrid& pressure) const;

 private:
  OneBeam(const SonarHead& head, const Medium& medium, double tolerance, double widest, double split);

  double split_;                     ///< |u| beyond which the ends of the array suffice
  BeamTables whole_;                 ///< for smaller |u|
  std::unique_ptr<BeamTables> end_;  ///< for larger |u|; nullptr: no such echoes
  double guard_;                     ///< bins that responses reach
  TimeStretches stretches_;
};

}  // namespace insonify
