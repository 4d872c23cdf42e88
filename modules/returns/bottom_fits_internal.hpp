// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "sonar/beam_fan.hpp"

namespace insonify {

/// One beam's samples for bottom detection; all spans have one entry per bin.
struct BottomBeam {
  std::span<const double> intensity;  ///< [Pa^2]
  std::span<const double> floor;      ///< samples up to this intensity are side lobes [Pa^2]
  std::span<const double> gain;       ///< r^4 and absorption
  std::span<const float> phase;       ///< phase between the halves [rad]; empty: none
  double noise = 0;                   ///< mean intensity of the noise [Pa^2]
  double first = 0, step = 0;         ///< range of bin 0, distance between bins [m]

  /// Returns intensity less noise, times gain; 0 for a side lobe. May be negative.
  double compensated(std::size_t n) const { return intensity[n] > floor[n] ? (intensity[n] - noise) * gain[n] : 0; }

  double range(std::size_t n) const { return first + static_cast<double>(n) * step; }
};

/// Predicted properties of the echo of a smooth bottom in a beam.
struct BottomEcho {
  double pulse_deviation = 0;      ///< standard deviation of the pulse's intensity in range [m]
  double footprint_deviation = 0;  ///< standard deviation of the ranges in the beam, weighted by its pattern [m]
  double half_power_reach = 0;     ///< half the range between the beam's -3 dB directions [m]
  double phase_slope = 0;          ///< slope of the phase between the halves over range [rad/m]
  double lengthening = 0;          ///< mean range of a plane over the footprint, less that on the beam's axis [m]
  double lengthening_along = 0;    ///< part of `lengthening` that is due to the footprint along the track [m]
  double along_deviation = 0;      ///< part of footprint_deviation that is due to the footprint along the track [m]
  double range_curvature = 0;      ///< r'' / (2 r'^2) of a plane's range over the direction cosine of the fan [1/m]
};

/// Returns the echo of a plane that crosses the axis of a beam of direction cosine `sine` at `range` [m]. `slope` is
/// dr/du there [m], `pulse_deviation` the pulse's standard deviation in range [m]. (E94, E132)
BottomEcho echo_of_plane(const BeamFan& fan, double sine, double range, double slope, double pulse_deviation);

/// A range with its standard deviation [m], which is infinite if there is no estimate.
struct BottomEstimate {
  double range = 0, deviation = 0;
};

/// Returns the median of `values`, at least one: the middle value, or the mean of the two middle ones. Reorders
/// `values`.
double median_of(std::vector<double>& values);

/// Returns the mean of exponential noise, estimated from the smallest quarter of the intensities, which an echo hardly
/// changes. The estimate is that of maximum likelihood from censored samples: chi-square with twice as many degrees of
/// freedom as samples used.
double noise_of(std::vector<double> values);

/// Returns the centre of gravity near `start` and its predicted deviation (E94). The pulse has the standard deviation
/// s_p (in intensity), the footprint s_f. Speckle then gives the variance (s_f^2 / 2) / sqrt(1 + s_f^2 / s_p^2), and
/// noise adds to it.
BottomEstimate centre_of_gravity(const BottomBeam& beam, const BottomEcho& echo, double start);

/// Returns the slope of the phase over range near `start` for a short pulse [rad/m]. Returns nothing with fewer than
/// two independent samples.
std::optional<double> phase_slope(const BottomBeam& beam, const BottomEcho& echo, double start);

/// Returns the range at which the line through the phases near `start`, weighted by intensity, crosses zero (E95). The
/// deviation follows from the residuals of the fit and the coherence of the looks; it is infinite for a crossing
/// outside the beam. With fewer than eight independent samples the line has the slope of the echo. With many samples
/// the last fit takes the 64 nearest, over which a bottom is straight enough.
BottomEstimate zero_crossing(const BottomBeam& beam, const BottomEcho& echo, double start);

}  // namespace insonify
