#include "beamforming/synthesize_noise.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "beamforming/element_tile_internal.hpp"
#include "beamforming/row_noise_internal.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t rows_at_once = 128;  // rows of beams per pass, which bounds the memory for element series

using Complex = std::complex<double>;

/// Taps h_-K .. h_K of the receive filter for a Gaussian pulse at the bin spacing: the pulse's envelope, cut at 1e-6,
/// with unit energy.
std::vector<double> gaussian_filter(const SonarHead& head, double step) {
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

/// Taps of a sweep's matched filter: the conjugate replica w(t) exp(i pi k t^2) at the bin spacing, the outermost taps
/// weighted by the fraction of their bins that the sweep covers, with unit energy (E55).
std::vector<Complex> matched_filter(const Pulse& pulse, double step) {
  const double half = 0.5 * pulse.duration, rate = pulse.bandwidth / pulse.duration;
  const auto reach = static_cast<int>(std::ceil(half / step));
  std::vector<Complex> taps;
  double energy = 0;
  for (int k = -reach; k <= reach; ++k) {
    const double covered = std::min((half - std::abs(k) * step) / step + 0.5, 1.0);
    if (covered <= 0) continue;
    const double t = std::clamp(k * step, -half, half);
    taps.push_back(std::polar(std::sqrt(covered) * replica_weight(pulse, t), pi * rate * t * t));
    energy += std::norm(taps.back());
  }
  for (Complex& tap : taps) tap /= std::sqrt(energy);
  return taps;
}

/// Receive filter: real taps for a Gaussian pulse, complex taps for a sweep.
struct ReceiveFilter {
  std::vector<double> real;
  std::vector<Complex> complex;

  ReceiveFilter(const SonarHead& head, double step) {
    if (head.pulse.shape == PulseShape::linear_fm)
      complex = matched_filter(head.pulse, step);
    else
      real = gaussian_filter(head, step);
  }
  std::size_t size() const { return real.size() + complex.size(); }
  Complex of(const Complex* white) const {
    Complex x = 0;
    for (std::size_t k = 0; k < real.size(); ++k) x += real[k] * white[k];  // (E41)
    for (std::size_t k = 0; k < complex.size(); ++k) x += complex[k] * white[k];
    return x;
  }
};

}  // namespace

ComplexGrid synthesize_noise(const SonarHead& head, const Medium& medium, double element_level_db,
                             const NoiseOptions& options) {
  require_valid(head, "synthesize_noise");
  require_valid(medium, "synthesize_noise");
  if (!std::isfinite(element_level_db))
    fail(ErrorKind::argument, "synthesize_noise: element_level_db = ", element_level_db, " dB, must be finite");
  const ReceiveFilter filter(head, 2 * head.gate.bin_size / medium.sound_speed);
  const double scale = std::numbers::sqrt2 * micropascal * amplitude_from_db(element_level_db);
  const double wavelength = medium.sound_speed / head.pulse.centre_frequency;
  const BeamSums beams(head, wavelength);
  const std::vector<FanRow> rows = fan_rows(head.fan);
  const RowNoise noise(head, wavelength, rows, options);
  const std::size_t bins = head.gate.bins(), elements = head.array.elements();
  ComplexGrid pressure(head.fan.beams(), bins);

  parallel_for((bins + tile_bins - 1) / tile_bins, options.threads, [&](std::size_t tile) {
    const std::size_t first = tile * tile_bins, last = std::min(first + tile_bins, bins);
    for (std::size_t row = 0; row < rows.size(); row += rows_at_once) {
      const std::size_t end_row = std::min(row + rows_at_once, rows.size());
      std::vector<ElementTile> series(end_row - row, ElementTile(elements));
      for (std::size_t m = 0; m < elements; ++m) {
        // White noise on this tile and the filter length around it, then the filter.
        const ComplexGrid white = noise.white(m, row, end_row, first, last - first + filter.size() - 1);
        for (std::size_t r = 0; r < series.size(); ++r) {
          for (std::size_t n = 0; n < last - first; ++n) {
            const Complex x = filter.of(&white(r, n));
            series[r].re(n, m) = scale * x.real();
            series[r].im(n, m) = scale * x.imag();
          }
        }
      }
      for (std::size_t r = 0; r < series.size(); ++r)
        beams.form_beams(series[r], first, last, rows[row + r].beams, pressure);
    }
  });
  return pressure;
}

}  // namespace insonify
