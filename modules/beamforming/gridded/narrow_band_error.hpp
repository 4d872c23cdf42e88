// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <vector>

#include "sampling/scatterers.hpp"
#include "sonar/pulse_kind.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// Expected error of the narrow-band, far-field image (E10), compared with the pressure that elements receive. The
/// paths from echo and focus to an element at y differ. At frequency f off the carrier, the true phase of the element
/// is k (1 + (f + d) / f_c) times this difference (E61, E62), d being the Doppler shift of the echo; the narrow-band image
/// uses -k y (u - u_b). The focus is at the range of the bin; the error is evaluated with the focus one pulse length
/// before and behind the echo. A planar array is represented by its middle row, a curved one by its places across.
class NarrowBandError {
 public:
  /// Keeps a reference to `head`, which must outlive the object; sound_speed [m/s].
  NarrowBandError(const SonarHead& head, double sound_speed);

  /// Sums over beams [Pa^2] of the squared error and of the squared image.
  struct Sums {
    double error = 0, image = 0;
  };

  /// Returns the expected sums for echoes from `positions` whose power at an element is `power` [Pa^2] and whose carrier is
  /// shifted by `doppler` [Hz; empty: nothing moves]; zero sums if `power` is empty. The sums are estimated from 32 to 48 places that each represent the same power, in the 16
  /// beams whose main or grating lobes are nearest and in 8 of the other beams.
  Sums of(const Scatterers& positions, const std::vector<double>& power, const std::vector<double>& doppler,
          int threads = 0) const;

 private:
  /// An echo that stands for `times` echoes.
  struct Echo {
    double range, u, times;
    double carrier;  ///< received carrier [Hz]
  };
  Sums of_echo(const Echo& echo) const;
  void add_beam(const Echo& echo, double u_beam, double weight, Sums& sums) const;

  const SonarHead& head_;
  std::array<SpectrumNode, 5> nodes_;
  double cycles_per_m_, off_focus_;
  std::vector<double> u_beam_, y_, shading_;
};

}  // namespace insonify
