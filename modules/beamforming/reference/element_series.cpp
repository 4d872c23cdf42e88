// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/reference/element_series.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "beamforming/numerics/gridding_kernel_internal.hpp"
#include "beamforming/numerics/path_difference_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/pulses/time_axis_internal.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
namespace {

void require_tolerance(const ElementOptions& options, const char* who) {
  if (!(options.tolerance >= min_element_tolerance && options.tolerance <= max_element_tolerance))
    fail(ErrorKind::argument, who, ": tolerance = ", options.tolerance, ", must be within ", min_element_tolerance,
         " and ", max_element_tolerance);
}

/// Path difference [m] between the element at `p` and the origin of the head.
double path_difference(Wavefront wavefront, double range, const Eigen::Vector3d& from, const Eigen::Vector3d& p) {
  if (wavefront == Wavefront::plane) return -p.y() * from.y() - p.x() * from.x() - p.z() * from.z();
  return insonify::path_difference(range, from, p);
}

/// Kaiser-windowed sinc interpolation for signals that fill at most half of the band.
class Interpolator {
 public:
  explicit Interpolator(double tolerance) {
    const double attenuation_db = -db_from_amplitude(tolerance) + 10;
    width_ = 2 * static_cast<std::size_t>(std::ceil((attenuation_db - 8) / (2.285 * pi) / 2));
    const double beta = attenuation_db > 50 ? 0.1102 * (attenuation_db - 8.7)
                                            : 0.5842 * std::pow(std::max(0.0, attenuation_db - 21), 0.4) +
                                                  0.07886 * std::max(0.0, attenuation_db - 21);
    const double half = 0.5 * static_cast<double>(width_);
    const auto value = [=](double x) {
      const double z = x / half, window = z * z < 1 ? std::cyl_bessel_i(0, beta * std::sqrt(1 - z * z)) : 1;
      return (std::abs(x) < 1e-9 ? 1 : std::sin(pi * x) / (pi * x)) * window / std::cyl_bessel_i(0, beta);
    };
    pieces_ = PolynomialPieces<double>::fit(value, -half, width_, 0.1 * tolerance);
  }
  std::size_t width() const { return width_; }

  /// Computes the weights of samples first, first + 1, ... for the value at `position` [samples]; returns first.
  std::ptrdiff_t weights(double position, std::vector<double>& weight) const {
    const double low = position - 0.5 * static_cast<double>(width_), first = std::ceil(low), t = 2 * (first - low) - 1;
    weight.resize(pieces_.lanes);
    for (std::size_t l = 0; l < pieces_.lanes; ++l) weight[l] = pieces_.coefficient[l];
    for (std::size_t k = 1; k <= pieces_.degree; ++k)
      for (std::size_t l = 0; l < pieces_.lanes; ++l)
        weight[l] = weight[l] * t + pieces_.coefficient[k * pieces_.lanes + l];
    return static_cast<std::ptrdiff_t>(first);
  }

 private:
  std::size_t width_;
  PolynomialPieces<double> pieces_;
};

}  // namespace

ElementSeries element_series(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                             const ElementOptions& options) {
  require_synthesis(echoes, head, medium, {options.tolerance, options.threads}, "element_series");
  require_one_row(head, "element_series", false);
  require_tolerance(options, "element_series");
  const double c = medium.sound_speed, f = head.pulse.centre_frequency;
  const auto array = receive_array(head);
  double farthest = 0;
  for (const Eigen::Vector3d& p : array->positions()) farthest = std::max(farthest, p.norm());
  std::vector<Eigen::Vector3d> from;
  for (std::size_t i = 0; i < echoes.size(); ++i) from.push_back(direction_of_echo(echoes, i));

  // Time axis: sampled finely enough for the band, and longer than the gate by array length and interpolation width.
  ElementSeries series;
  series.step = 1 / (4 * head.pulse.bandwidth * kind_of(head.pulse).relative_band(head.pulse, 0.1 * options.tolerance));
  const double beyond = farthest / c + static_cast<double>(Interpolator(options.tolerance).width()) * series.step;
  series.start = 2 * head.gate.centre(0) / c - beyond;
  const double end = 2 * head.gate.centre(head.gate.bins() - 1) / c + beyond;
  const auto samples = static_cast<std::size_t>(std::ceil((end - series.start) / series.step)) + 1;
  series.pressure.setZero(head.array.elements(), samples);

  // Each element is computed by one thread, which adds the echoes in order.
  const PulseReach reach(head.pulse, medium.absorption, c, !echoes.doppler.empty(), 0.1 * options.tolerance);
  const EchoShapes shapes(head.pulse, medium);
  parallel_for(head.array.elements(), options.threads, [&](std::size_t m) {
    const Eigen::Vector3d p = array->positions()[m];
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      const double extra_delay = path_difference(options.wavefront, 0.5 * c * echoes.delay[i], from[i], p) / c;
      const double arrival = echoes.delay[i] + extra_delay, half = reach.at(echoes.delay[i]);
      const double first = std::max(0.0, std::ceil((arrival - half - series.start) / series.step));
      const double last =
          std::min(static_cast<double>(samples) - 1, std::floor((arrival + half - series.start) / series.step));
      const EchoEnvelope envelope = shapes.of(echoes.delay[i], echoes.doppler_of(i));
      const std::complex<double> amplitude =
          echoes.amplitude[i] * std::polar(1.0, 2 * pi * reduced_cycles(f * extra_delay));
      for (double n = first; n <= last; ++n)
        series.pressure(m, static_cast<Eigen::Index>(n)) +=
            amplitude * envelope.at(series.start + n * series.step - arrival);  // (E61)
    }
  });
  return series;
}

ComplexGrid beam_from_elements(const ElementSeries& series, const SonarHead& head, const Medium& medium,
                               const ElementOptions& options) {
  require_valid(head, "beam_from_elements");
  require_valid(medium, "beam_from_elements");
  require_one_row(head, "beam_from_elements", false);
  require_tolerance(options, "beam_from_elements");
  const std::size_t elements = head.array.elements();
  if (series.pressure.rows() != static_cast<Eigen::Index>(elements) || !(series.step > 0))
    fail(ErrorKind::argument, "beam_from_elements: the series has ", series.pressure.rows(), " elements and steps of ",
         series.step, " s, must have ", elements, " elements as the head, and a step > 0");
  const double c = medium.sound_speed, f = head.pulse.centre_frequency;
  const Interpolator interpolator(options.tolerance);
  const std::vector<Eigen::Vector3d> axes = beam_axes(head.fan);
  const auto array = receive_array(head);
  const std::size_t bins = head.gate.bins();
  ComplexGrid beams(axes.size(), bins);

  parallel_for(axes.size(), options.threads, [&](std::size_t b) {
    std::vector<double> weight;
    beams.row(b).setZero();
    for (std::size_t m = 0; m < elements; ++m) {
      const Eigen::Vector3d p = array->positions()[m];
      const double shading = head.array.shading[m] / static_cast<double>(elements);
      for (std::size_t n = 0; n < bins; ++n) {
        const double t = 2 * head.gate.centre(n) / c;
        const double extra_delay = path_difference(options.wavefront, head.gate.centre(n), axes[b], p) / c;
        const std::ptrdiff_t first = interpolator.weights((t + extra_delay - series.start) / series.step, weight);
        if (first < 0 || first + static_cast<std::ptrdiff_t>(interpolator.width()) > series.pressure.cols())
          fail(ErrorKind::argument, "beam_from_elements: bin ", n, " of beam ", b, " needs samples outside the series");
        std::complex<double> value = 0;
        for (std::size_t k = 0; k < interpolator.width(); ++k)
          value += weight[k] * series.pressure(m, first + static_cast<std::ptrdiff_t>(k));
        beams(b, n) += value * std::polar(shading, -2 * pi * reduced_cycles(f * extra_delay));  // (E62)
      }
    }
  });
  return beams;
}

}  // namespace insonify
