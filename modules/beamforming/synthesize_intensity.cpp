// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/synthesize_intensity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "beamforming/gridded/gridded_engine.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/pulses/time_axis_internal.hpp"
#include "beamforming/row_echoes_internal.hpp"
#include "core/parallel.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
namespace {

constexpr std::size_t intensities_at_once = 256;

/// Input of the synthesis of a line-array image.
struct LineInput {
  Echoes echoes;
  SonarHead head;
  Medium medium;
};

LineArray squared(const LineArray& array) {
  const std::vector<double> pairs = lag_sums(array);
  const std::size_t n = pairs.size();
  const auto elements = static_cast<double>(n);
  LineArray result{array.spacing, std::vector<double>(2 * n - 1)};
  for (std::size_t lag = 0; lag < n; ++lag)  // array_response divides by 2N - 1 instead of N^2.
    result.shading[n - 1 + lag] = result.shading[n - 1 - lag] =
        pairs[lag] * (2 * elements - 1) / (elements * elements);  // (E65)
  return result;
}

/// Returns the input whose image is a sum of the squared magnitudes of the echoes of `image`, for Gaussian pulses.
LineInput squared(LineInput image) {
  const EchoShapes shapes(image.head.pulse, image.medium);
  const double sent = echo_envelope(image.head.pulse, {}, 0).a;
  for (std::size_t i = 0; i < image.echoes.size(); ++i) {
    const EchoEnvelope g = shapes.of(image.echoes.delay[i]);
    const double gain = std::sqrt(sent / g.a) * std::exp(g.b * g.b / (2 * g.a));  // (E65)
    image.echoes.amplitude[i] = gain * std::norm(image.echoes.amplitude[i]);
  }
  image.echoes.doppler.clear();
  image.head.array = squared(image.head.array);
  // Keep the spacing in wavelengths; twice the frequency keeps the bandwidth below twice the centre frequency.
  image.head.array.spacing /= 2;
  image.head.pulse.centre_frequency *= 2;
  image.head.pulse.bandwidth *= std::numbers::sqrt2;
  const Absorption& absorption = image.medium.absorption;
  image.medium.absorption = {2 * absorption.a0, 0, absorption.a2 / 2};
  return image;
}

/// Samples of |G|^2 of one echo, beginning at bin `first`.
struct SquaredPulse {
  std::size_t first = 0;
  std::vector<double> sample;
};

/// Direct sum of |A|^2 |B|^2 |G|^2 over echoes.
Grid<double> sum_directly(const LineInput& image, int threads) {
  const auto& [echoes, head, medium] = image;
  const double wavelength = medium.sound_speed / head.pulse.centre_frequency;
  const std::vector<Eigen::Vector3d> beams = beam_axes(head.fan);
  const auto array = receive_array(head);
  const EchoShapes shapes(head.pulse, medium);
  const TimeAxis axis(head.gate, medium.sound_speed);
  Grid<double> sum = Grid<double>::Zero(head.fan.beams(), axis.bins);
  for (std::size_t first = 0; first < echoes.size(); first += intensities_at_once) {
    const std::size_t count = std::min(intensities_at_once, echoes.size() - first);
    std::vector<SquaredPulse> pulses(count);
    parallel_for(count, threads, [&](std::size_t k) {
      const double delay = echoes.delay[first + k];
      const EchoEnvelope envelope = shapes.of(delay, echoes.doppler_of(first + k));
      const auto [begin, end] = axis.around(delay, kind_of(head.pulse).end(head.pulse));
      pulses[k].first = begin;
      for (std::size_t n = begin; n < end; ++n) {
        const double t = axis.start + static_cast<double>(n) * axis.step - delay;
        pulses[k].sample.push_back(std::norm(envelope.at(t)));
      }
    });
    parallel_for(head.fan.beams(), threads, [&](std::size_t b) {
      for (std::size_t k = 0; k < count; ++k) {
        const auto response = array->response(direction_of_echo(echoes, first + k), beams[b], wavelength);
        const double weight = std::norm(echoes.amplitude[first + k]) * std::norm(response);
        double* at = &sum(static_cast<Eigen::Index>(b), 0) + pulses[k].first;
        for (const double sample : pulses[k].sample) *at++ += weight * sample;  // (E65)
      }
    });
  }
  return sum;
}

/// Sum of |A|^2 |B|^2 |G|^2 over the echoes of one row of beams.
Grid<double> sum_of_squares(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                            const SynthesisOptions& options) {
  LineInput image{echoes, head, medium};
  if (!is_gaussian(head.pulse) || !has_line(head)) return sum_directly(image, options.threads);
  image = squared(std::move(image));
  return synthesize_gridded(image.echoes, image.head, image.medium, options).real().max(0);
}

}  // namespace

Grid<double> synthesize_intensity(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                  const SynthesisOptions& options) {
  require_synthesis(echoes, head, medium, options, "synthesize_intensity");
  const SynthesisOptions squares{std::max(min_gridding_tolerance, options.tolerance * options.tolerance),
                                 options.threads};
  return image_by_rows<Grid<double>>(
      echoes, head, medium, row_cutoff(options.tolerance, fan_rows(head.fan).size()), options.threads,
      [&](const Echoes& of_row, const SonarHead& line) { return sum_of_squares(of_row, line, medium, squares); });
}

}  // namespace insonify
