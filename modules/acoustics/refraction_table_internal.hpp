// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "acoustics/sound_speed_profile.hpp"

namespace insonify {

/// Apparent place of a point for the head: range [m] and unit vector of the direction from which sound arrives.
struct ApparentPosition {
  double range = 0;
  double horizontal = 0, up = 0;
  double gain = 0;     ///< log of the tube's spreading (E167) times range^2, at most log(most_focusing)
  double arrival = 0;  ///< elevation of the ray at the point [rad]
};

/// The depths [m] and horizontal distances [m] of a scene, and how many points it has.
struct DepthBox {
  double min_depth = 0, max_depth = 0, min_horizontal = 0, max_horizontal = 0;
  std::size_t points = 0;
};

/// Rays to first order in the change of sound speed: the delay of the straight way, its gradient at the head for
/// direction. Exact in the layering; off by the square of the bending.
class FirstOrderRays {
 public:
  FirstOrderRays(const SoundSpeedProfile& profile, double head_depth);
  ApparentPosition apparent(double depth, double horizontal) const;

 private:
  double lead(double height, double speed, double gradient) const;

  double head_depth_, head_speed_;
  std::vector<double> depth_, speed_;  ///< the profile's entries with the head among them
  std::vector<double> lead_;           ///< integral of 1/c_head - 1/c from the head's depth to theirs
};

/// Rays between a head and any point of a box: to first order, and their small rest interpolated between eigenrays by
/// parabolas, in patches that are quartered where that is not close.
class RefractionTable {
 public:
  /// Without a box, or with one of few points, every ray is solved. `profile` must outlive the table.
  RefractionTable(const SoundSpeedProfile& profile, double head_depth, const DepthBox& box, int threads);

  /// Returns the apparent position; none in a shadow zone.
  std::optional<ApparentPosition> apparent(double depth, double horizontal) const;

 private:
  /// Eigenray less first order; its arrival less the straight way's.
  struct Rest {
    double range = 0, angle = 0, gain = 0, arrival = 0;
    bool reachable = false;
  };
  enum class Use : char { interpolate, shadow, solve, quarter };
  struct Patch {
    std::array<Rest, 9> rest;  ///< three rows over depth, three columns over distance
    Use use = Use::solve;
    std::unique_ptr<std::array<Patch, 4>> quarters;
  };
  struct Frame {
    double depth = 0, horizontal = 0, height = 0, width = 0;
    Frame quarter(std::size_t q) const;
  };

  std::optional<ApparentPosition> solve(double depth, double horizontal) const;
  Rest rest(const Frame& frame, double down, double out) const;
  static Rest between(const Patch& patch, double down, double out);
  void fill(const DepthBox& box, int threads);
  /// Decides on the use of a patch whose nine rests are known; `levels` more quarterings may be made.
  void decide(Patch& patch, const Frame& frame, int levels) const;
  void quarter(Patch& patch, const Frame& frame, const std::array<Rest, 4>& middles, int levels) const;

  const SoundSpeedProfile& profile_;
  double head_depth_, head_speed_;
  FirstOrderRays first_order_;
  std::vector<double> rows_;  ///< edges of the rows of patches [m]; empty: no table
  double min_horizontal_ = 0, width_ = 0;
  std::vector<Patch> patches_;
};

}  // namespace insonify
