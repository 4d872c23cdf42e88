// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "acoustics/echoes.hpp"
#include "core/grid.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// Shape of the wavefronts at the array.
enum class Wavefront {
  spherical,  ///< centred at the echo's apparent range (half its delay): exact also in the near field
  plane       ///< a plane wave, as from infinite range
};

/// Range of tolerances that element_series and beam_from_elements accept.
constexpr double min_element_tolerance = 1e-12, max_element_tolerance = 0.1;

/// Options of element_series and beam_from_elements.
struct ElementOptions {
  double tolerance =
      1e-4;  ///< relative error of series and beams, within min_element_tolerance and max_element_tolerance
  Wavefront wavefront = Wavefront::spherical;
  int threads = 0;  ///< 0: all cores; the result does not depend on it
};

/// Pressure received by each element of an array, elements x samples [Pa], complex baseband about the carrier. Element
/// m of a line is at y = (m - (N-1)/2) spacing, positive to port, that of an arc as in E205; sample n is at time start
/// + n step [s] after transmission.
struct ElementSeries {
  double start = 0, step = 0;
  ComplexGrid pressure;
};

/// Returns the series of all elements with true delays per element (E61), without the far-field and narrow-band
/// assumptions on receive:
///
///   x_m(t) = sum_i A_i exp(2 pi i f_c d_im / c) G_i(t - delay_i - d_im / c)
///   d_im   = sqrt(r_i^2 - 2 r_i p_m d_i + p_m^2) - r_i (spherical) or -p_m d_i (plane), p_m d_i = y_m u_i of a line
///
/// The sampling rate is about four times the band of the pulse, so that beams can interpolate between samples. The
/// series extends beyond the gate by the length of the array. External beamformers can use the series;
/// beam_from_elements is the built-in beamformer. The cost is echoes x elements x pulse samples. Throws Error as
/// synthesize_direct does, and for a tolerance out of range.
ElementSeries element_series(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                             const ElementOptions& options = {});

/// Returns delay-and-sum beams of `series`, beams x bins [Pa] (E62). A sample of a beam sums the elements at the times
/// at which a wavefront from the beam's direction reaches them. A spherical wavefront also has the range of the sample,
/// so the beam is dynamically focused:
///
///   p_b(t) = (1/N) sum_m w_m exp(-2 pi i f_c d_mb / c) x_m(t + d_mb / c)
///
/// A Kaiser-windowed sinc interpolates between samples, accurate to the tolerance. Throws Error if the series does not
/// match the head.
ComplexGrid beam_from_elements(const ElementSeries& series, const SonarHead& head, const Medium& medium,
                               const ElementOptions& options = {});

}  // namespace insonify
