// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <vector>

#include "acoustics/refract_paths.hpp"

/// Rays through layers of constant gradient, named by their steepness. With c_m the highest sound speed between the
/// two ends, a ray of steepness Q (square of the tangent of its slope where sound speed is c_m) has at sound speed c
/// the sine sqrt(Q + delta) / sqrt(1 + Q), delta = (c_m - c)(c_m + c) / c_m^2: no cancellation however flat the ray.
namespace insonify {

/// Part of a layer that a ray crosses from one end to the other.
struct LayerCrossing {
  double height = 0;      ///< [m]
  double gradient = 0;    ///< absolute [1/s]
  double root_speed = 0;  ///< geometric mean of the sound speeds at its ends
  double reach = 0;       ///< height (c_1 + c_2) / c_m
  double delta_1 = 0, delta_2 = 0;
  double horizontal(double steepness) const;
};

/// Where rays that leave through one end turn: within one layer, behind some crossings of that side.
struct TurningInterval {
  double steepness_min = 0, steepness_max = 0;
  std::size_t crossings = 0;  ///< how many of the side lie before the turning layer
  double delta = 0;           ///< where the turning layer begins
  double gradient = 0;        ///< absolute gradient of the turning layer [1/s]
  double speed = 0;           ///< sound speed where the turning layer begins [m/s]
};

/// The layers above the upper end, or below the lower one.
struct RaySide {
  std::vector<LayerCrossing> crossings;  ///< crossed layers, outwards
  std::vector<TurningInterval> turning;  ///< turning intervals, in order of steepness
};

/// Numbers of crossings of the water between the ends, and of turns above and below, of the rays of a family.
struct RayFamily {
  int between = 1, above = 0, below = 0;
  const TurningInterval* turn_above = nullptr;
  const TurningInterval* turn_below = nullptr;
};

/// The water around two depths, upper <= lower, for rays that go at most `horizontal` far.
class RayWater {
 public:
  RayWater(const SoundSpeedProfile& profile, double upper, double lower, double horizontal);

  const RaySide& above() const { return above_; }
  const RaySide& below() const { return below_; }

  /// Returns the horizontal distance that a ray of `steepness` covers.
  double horizontal(const RayFamily& family, double steepness) const {
    return horizontal(family, steepness, steepness);
  }
  /// Returns the distance with a steepness of their own for crossings, which shrink with it, and turns, which grow: the
  /// ends of an interval give a bound over it.
  double horizontal(const RayFamily& family, double crossing_steepness, double turning_steepness) const;
  /// Returns the steepness of the ray that runs from end to end without a turn and covers `horizontal`; none if there
  /// is no such ray.
  std::optional<double> direct_steepness(double horizontal) const;
  /// Time along the chords of its arcs, these stretched to end exactly at `horizontal`: by Fermat's principle an error
  /// of `steepness` enters squared.
  double travel_time(const RayFamily& family, double steepness, double horizontal) const;
  /// Tangents of its slope at both ends, not negative.
  double tangent_upper(double steepness) const;
  double tangent_lower(double steepness) const;

 private:
  double delta(double speed) const { return (highest_ - speed) * (highest_ + speed) / (highest_ * highest_); }
  void add_crossing(std::vector<LayerCrossing>& list, double height, double speed_1, double speed_2) const;
  RaySide side(const SoundSpeedProfile& profile, double from, int step, double horizontal) const;

  double highest_ = 0;  ///< c_m [m/s]
  double speed_upper_ = 0, speed_lower_ = 0;
  std::vector<LayerCrossing> between_;
  RaySide above_, below_;
};

/// Travel time [s] of the arc over a chord [m] in water of constant absolute gradient [1/s] (E43); `root_speed` is the
/// geometric mean of the sound speeds at its ends.
double arc_time(double chord, double gradient, double root_speed);

/// find_eigenray for a valid profile and finite arguments, horizontal >= 0; none in a shadow zone.
std::optional<Eigenray> eigenray_between(const SoundSpeedProfile& profile, double depth_from, double depth_to,
                                         double horizontal);

}  // namespace insonify
