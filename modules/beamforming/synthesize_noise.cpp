#include "beamforming/synthesize_noise.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "beamforming/element_tile_internal.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

/// Taps h_-K .. h_K of the receive filter on the bins of the gate: the pulse's envelope, cut at 1e-6, with unit energy.
std::vector<double> receive_filter(const SonarHead& head, double sound_speed) {
  const double step = 2 * head.gate.bin_size / sound_speed;
  const auto reach = static_cast<int>(std::ceil(pulse_half_length(head.pulse, 1e-6) / step));
  const EchoEnvelope envelope = echo_envelope(head.pulse, {}, 0);
  std::vector<double> taps;
  double energy = 0;
  for (int k = -reach; k <= reach; ++k) {
    taps.push_back(envelope.at(k * step).real());
    energy += taps.back() * taps.back();
  }
  for (double& tap : taps) tap /= std::sqrt(energy);
  return taps;
}

}  // namespace

ComplexGrid synthesize_noise(const SonarHead& head, const Medium& medium, double element_level_db,
                             const NoiseOptions& options) {
  require_valid(head, "synthesize_noise");
  require_valid(medium, "synthesize_noise");
  if (!std::isfinite(element_level_db))
    fail(ErrorKind::argument, "synthesize_noise: element_level_db = ", element_level_db, " dB, must be finite");
  const std::vector<double> taps = receive_filter(head, medium.sound_speed);
  const double scale = std::numbers::sqrt2 * micropascal * amplitude_from_db(element_level_db);
  const BeamSums beams(head, medium.sound_speed / head.pulse.centre_frequency);
  const std::size_t bins = head.gate.bins(), elements = head.array.elements();
  ComplexGrid pressure(head.fan.beams(), bins);

  parallel_for((bins + tile_bins - 1) / tile_bins, options.threads, [&](std::size_t tile) {
    const std::size_t first = tile * tile_bins, last = std::min(first + tile_bins, bins);
    ElementTile series(elements);
    std::vector<std::complex<double>> white(last - first + taps.size() - 1);
    for (std::size_t m = 0; m < elements; ++m) {
      // White noise on this tile's bins and the filter's reach around them, then the filter.
      for (std::size_t n = 0; n < white.size(); ++n)
        white[n] = random_complex_normal(options.seed, RandomStage::noise,
                                         {static_cast<std::uint64_t>(options.ping), m, first + n});
      for (std::size_t n = 0; n < last - first; ++n) {
        std::complex<double> x = 0;
        for (std::size_t k = 0; k < taps.size(); ++k) x += taps[k] * white[n + k];  // (E41)
        series.re(n, m) = scale * x.real();
        series.im(n, m) = scale * x.imag();
      }
    }
    beams.form_beams(series, first, last, pressure);
  });
  return pressure;
}

}  // namespace insonify
