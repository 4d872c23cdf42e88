// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "acoustics/motion.hpp"
#include "tool/export/product_run.hpp"

/// Uncertainties of soundings by the deviations of a vehicle's instruments.
namespace insonify::tool {

/// Sources of uncertainty, in the order of CSV.
inline constexpr std::array uncertainty_terms = {"detection", "attitude", "heading",     "position",
                                                 "height",    "latency",  "sound_speed", "surface_sound_speed"};

/// Where a sounding lies and how it was made. Axes are level: ahead, to starboard, down.
struct SoundingGeometry {
  Eigen::Vector3d from_head = Eigen::Vector3d::Zero();     ///< the sounding from the head [m]
  Eigen::Vector3d from_vehicle = Eigen::Vector3d::Zero();  ///< the sounding from the vehicle's origin [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< velocity of a point fixed to the vehicle there [m/s]
  double range_deviation = 0;                              ///< standard deviation of the range [m]
  double steering = 0;     ///< angle of the beam from the broadside of its array [rad], positive to starboard
  double sound_speed = 0;  ///< at the head [m/s]
};

/// Uncertainty of a sounding by its sources, and in all.
struct SoundingUncertainty {
  /// Standard deviations of each source: ahead, to starboard, down [m].
  std::array<Eigen::Vector3d, uncertainty_terms.size()> terms{};
  double vertical = 0;  ///< standard deviation of the depth [m]
  double tvu = 0;       ///< total vertical uncertainty at 95 % [m]
  double thu = 0;       ///< total horizontal uncertainty: radius that holds 95 % [m]
};

/// Returns the uncertainty of a sounding (E214): each source turns or moves the sounding in proportion to its
/// deviation, and sources are independent. The TVU is 1.96 deviations of the depth; the THU is the radius that holds
/// 95 % of a normal distribution in the plane (Leenhouts 1985, within 0.2 %).
SoundingUncertainty uncertainty_of(const SoundingGeometry& sounding, const InstrumentDeviations& instruments);

/// The uncertainties of the soundings of a run.
class RunUncertainty {
 public:
  /// Keeps the run, which must outlive this.
  explicit RunUncertainty(const PlacedRun& run);

  /// Returns true if the mission states how good the instruments are. Without that there are no uncertainties.
  bool known() const { return run_.pings.instruments.has_value(); }
  /// Returns the uncertainty of sounding i of a ping. Must be known.
  SoundingUncertainty at(const Ping& ping, const BottomSoundings& found, std::size_t i) const;

 private:
  const PlacedRun& run_;
  std::optional<Trajectory> way_;
};

/// Returns the names of the columns of uncertainty in CSV, which a run has whose mission states its instruments.
std::vector<std::string> uncertainty_columns();
/// Returns their numbers [m], in that order: TVU and THU, then of each source the vertical and the horizontal
/// deviation.
std::vector<double> uncertainty_numbers(const SoundingUncertainty& uncertainty);

}  // namespace insonify::tool
