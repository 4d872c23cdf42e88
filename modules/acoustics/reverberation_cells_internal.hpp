// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <vector>

#include "acoustics/reverberation_echoes.hpp"
#include "core/random.hpp"

namespace insonify {

/// Slices of range and azimuth that fill gate and sector. Slices of range are counted from the head on, so that they
/// are the same for every gate.
struct ReverberationCells {
  double length = 0;       ///< length of a slice [m]
  double nearest = 0;      ///< where the first slice is cut off [m]
  std::size_t first = 0;   ///< number of the first slice, counted from the head
  std::size_t slices = 0;  ///< number of slices
  double azimuths = 0;     ///< how many resolvable steps make a whole turn, before rounding up
  Sector sector;           ///< sector of all elevations

  double begin(std::size_t slice) const;
  double end(std::size_t slice) const { return static_cast<double>(first + slice + 1) * length; }
};

/// Throws Error for invalid arguments.
ReverberationCells reverberation_cells(const BeamFan& fan, const RangeGate& gate, const Transmission& transmission,
                                       const ReverberationOptions& options, const char* who);

/// Throws Error if slices x directions exceed 2^27.
void require_few(double directions, const ReverberationCells& cells, const char* who);

/// Returns the amplitude of one cell, complex normal; 1 for SurfaceAmplitude::mean_power.
std::complex<double> cell_amplitude(const EchoOptions& echo_options, RandomStage stage, const RandomCounter& counter);

/// The two-way elevation pattern as an intensity over solid angle, b^2(e) cos(e), to integrate and to draw from.
class ElevationLaw {
 public:
  ElevationLaw(const BeamFan& fan, const EchoOptions& echo_options);
  double integral() const { return integral_; }   ///< [rad]
  double elevation_at(double share) const;        ///< below which `share`, in [0, 1], of the integral lies [rad]
  double extent() const { return high_ - low_; }  ///< [rad]

 private:
  double low_, high_, integral_ = 0;
  std::vector<double> sum_;  // of the integral, up to each of equal steps from low_ to high_
};

/// A uniform number in [0, 1) made two: its leading bits and the rest.
struct TwoUniform {
  double leading, rest;
};
TwoUniform split_uniform(double uniform);

}  // namespace insonify
