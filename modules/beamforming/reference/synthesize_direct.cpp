// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <complex>
#include <vector>

#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/synthesize.hpp"
#include "core/parallel.hpp"
#include "core/work_progress.hpp"

namespace insonify {
namespace {

using Complex = std::complex<double>;
constexpr std::size_t echoes_at_once = 256;
constexpr std::size_t bins_at_once = 256;

/// Weights A_i B_b(u_i) of the echoes [first, last) in every beam: (last - first) x beams.
ComplexGrid beam_weights(const Echoes& echoes, std::size_t first, std::size_t last, const SonarHead& head,
                         const Medium& medium, int threads) {
  const double wavelength = medium.sound_speed / head.pulse.centre_frequency;
  const std::vector<Eigen::Vector3d> beams = beam_axes(head.fan);
  const auto array = receive_array(head);
  ComplexGrid weights(last - first, beams.size());
  parallel_for(last - first, threads, [&](std::size_t i) {
    const Eigen::Vector3d from = direction_of_echo(echoes, first + i);
    for (std::size_t b = 0; b < beams.size(); ++b)
      weights(i, b) = echoes.amplitude[first + i] * array->response(from, beams[b], wavelength);
  });
  return weights;
}

}  // namespace

ComplexGrid synthesize_direct(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                              const SynthesisOptions& options) {
  require_synthesis(echoes, head, medium, options, "synthesize_direct");
  require_one_row(head, "synthesize_direct", false);
  const std::size_t beams = head.fan.beams(), bins = head.gate.bins();
  ComplexGrid pressure = ComplexGrid::Zero(beams, bins);
  const EchoShapes shapes(head.pulse, medium);

  // Blocks of echoes in order; within a block, each tile of bins is computed by one thread.
  ObservedLoop blocks((echoes.size() + echoes_at_once - 1) / echoes_at_once);
  for (std::size_t first = 0; first < echoes.size(); first += echoes_at_once) {
    const std::size_t last = std::min(first + echoes_at_once, echoes.size());
    const ComplexGrid weights = beam_weights(echoes, first, last, head, medium, options.threads);
    parallel_blocks(bins, bins_at_once, options.threads, [&](std::size_t begin, std::size_t end) {
      Eigen::ArrayXcd pulse(end - begin);
      for (std::size_t i = first; i < last; ++i) {
        const EchoEnvelope envelope = shapes.of(echoes.delay[i], echoes.doppler_of(i));
        for (std::size_t n = begin; n < end; ++n)
          pulse[n - begin] = envelope.at(2 * head.gate.centre(n) / medium.sound_speed - echoes.delay[i]);
        for (std::size_t b = 0; b < beams; ++b)
          pressure.row(b).segment(begin, end - begin) += weights(i - first, b) * pulse.transpose();  // (E12)
      }
    });
    blocks.advance();
  }
  return pressure;
}

}  // namespace insonify
