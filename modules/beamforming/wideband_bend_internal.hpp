#pragma once
#include <cstddef>
#include <vector>

#include "beamforming/wideband_plan_internal.hpp"

namespace insonify {

/// The bend of wavefronts over a block of time, as a short sum of products (E68): beyond the plane wave's delay -y u / c
/// an element at y receives from (r, u) by b / c later, b = sqrt(r^2 - 2 r y u + y^2) - r + y u, so that at frequency F
///
///   exp(2 pi i F b / c) = sum over terms of along(u, t) exp(2 pi i F delay(y)) rest(y, F)
///
/// each term's second factor being what places of the first kind (u, r) that represent all others give. Found by
/// elimination of sampled values (an interpolative decomposition), to a tolerance of their root mean square.
struct BendSeries {
  std::size_t terms = 0;
  std::size_t powers = 0;       ///< of time in [-1, 1] over the block, highest first
  double middle = 0, half = 1;  ///< of the block [s]
  std::size_t stride = 0;       ///< places, filled up to a multiple of 8
  std::vector<float> along;     ///< terms x powers x 2 (real, imaginary) x stride
  std::vector<double> delay;    ///< terms x elements [s]
  std::size_t rest_powers = 0;  ///< of frequency / half_band, highest first; none for beams
  std::vector<float> rest;      ///< terms x elements x rest_powers x 2
};

/// For echoes, at steps of the grid of directions. Gridding smears echoes over grid steps and the time of a pulse, over
/// which the bend changes: that is undone.
BendSeries bend_of_echoes(const WidebandPlan& plan, double first_time, double last_time);

/// The conjugate, for beams.
BendSeries bend_of_beams(const WidebandPlan& plan, double first_time, double last_time);

}  // namespace insonify
