// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "core/grid.hpp"
#include "returns/bottom_detection.hpp"
#include "returns/bottom_fits_internal.hpp"
#include "returns/lone_beam_internal.hpp"

namespace insonify {

/// Length of a uniform line in wavelengths times its -3 dB width [rad].
inline constexpr double half_power_of_line = 0.8859;

/// A found echo of a beam.
struct BottomFind {
  double range = 0, energy = 0;
};

/// All beams of a ping, prepared for detection.
class BottomPing {
 public:
  BottomPing(const Ping& ping, const BottomOptions& options);

  /// Returns the echoes of a beam by falling energy; at most options.per_beam.
  std::vector<BottomFind> find(std::size_t beam) const;
  /// Returns dr/du about a beam from the first echoes of its neighbours [m].
  double slope_at(std::size_t beam, const std::vector<std::vector<BottomFind>>& found) const;
  /// Returns the predicted echo of a plane of this slope.
  BottomEcho echo_at(std::size_t beam, double range, double slope, double turn) const;
  bool has_one_beam() const { return ping_.fan.beams() == 1; }
  /// Returns the level bed in the only beam of a ping.
  LonePlane lone_plane_at(double range) const;
  /// Returns the phase between the halves per direction cosine [rad], the median of all beams.
  double phase_per_cosine(const std::vector<std::vector<BottomFind>>& found, const std::vector<double>& slopes) const;
  BottomBeam beam_of(std::size_t beam) const;
  float level_db_near(std::size_t beam, double range, double reach) const;
  void judge(const std::vector<BottomEcho>& echoes, BottomSoundings& soundings) const;

 private:
  /// Returns half the footprint on a level bottom [bins], at least a pulse, for beams at this angle from the vertical.
  std::size_t reach_of(double tangent, double cosine, double range) const;
  /// Returns for each range the intensity up to which a sample is a side lobe, from that of the strongest beam.
  Eigen::Array<double, 1, Eigen::Dynamic> side_lobe_floor(
      const Eigen::Array<double, 1, Eigen::Dynamic>& strongest) const;
  /// Returns the largest distance in range between side lobes and their echo [m].
  double side_lobe_reach() const;

  const Ping& ping_;
  const BottomOptions& options_;
  Grid<double> intensity_;
  Eigen::Array<double, 1, Eigen::Dynamic> all_, floor_, gain_;  ///< one per bin
  std::vector<double> noise_, threshold_, cosine_, down_;
  double pulse_deviation_ = 0;
};

}  // namespace insonify
