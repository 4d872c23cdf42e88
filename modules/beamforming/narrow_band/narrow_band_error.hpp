// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <vector>

#include "sampling/scatterers.hpp"
#include "sonar/pulse_spectrum.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// The expected error of the narrow-band, far-field image (E10) against what elements receive: at frequency f off the
/// carrier the phase of element y is k (1 + f / f_c) times the difference of the ways to it that echo and focus have
/// (E61, E62); the narrow band takes -k y (u - u_b). The focus stands where the bin is: the pulse's length before and
/// behind the echo. A planar array counts as its middle row.
class NarrowBandError {
 public:
  /// Refers to the head.
  NarrowBandError(const SonarHead& head, double sound_speed);

  /// Sums over beams [Pa^2]: of the squared error, and of the squared image.
  struct Sums {
    double error = 0, image = 0;
  };

  /// Returns the expected sums of echoes from `places` with these powers at an element [Pa^2], none if `power` is
  /// empty. Some 32 to 48 of the places each stand for the same power, in the nearest 16 beams and 8 of the others.
  Sums of(const Scatterers& places, const std::vector<double>& power, int threads = 0) const;

 private:
  Sums of_echo(double range, double u, double times) const;
  void add_beam(double range, double u, double u_beam, double weight, std::vector<double>& room, Sums& sums) const;

  const SonarHead& head_;
  std::array<SpectrumNode, 5> nodes_;
  double cycles_per_m_, off_focus_;
  std::vector<double> u_beam_, y_, shading_;
};

}  // namespace insonify
