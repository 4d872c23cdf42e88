// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "beamforming/numerics/receive_filter_internal.hpp"
#include "core/units.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
namespace {

constexpr double few_bins = 8;  // bins of a signal below which its filter follows from its autocorrelation

using Complex = std::complex<double>;

/// Taps h_-K .. h_K of the receive filter for a Gaussian pulse at the bin spacing: the pulse's envelope, cut at 1e-6,
/// with unit energy.
std::vector<double> gaussian_filter(const Pulse& pulse, double step) {
  const auto reach = static_cast<int>(std::ceil(pulse_half_length(pulse, 1e-6) / step));
  const EchoEnvelope envelope = echo_envelope(pulse, {}, 0);
  std::vector<double> taps;
  double energy = 0;
  for (int k = -reach; k <= reach; ++k) {
    taps.push_back(envelope.at(k * step).real());
    energy += taps.back() * taps.back();
  }
  for (double& tap : taps) tap /= std::sqrt(energy);
  return taps;
}

/// Taps of a matched filter: the conjugate replica at the bin spacing, the outermost taps weighted by the fraction of
/// their bins that the signal covers, with unit energy (E55).
std::vector<Complex> matched_filter(const MatchedPulse& kind, const Pulse& pulse, double step) {
  const double half = 0.5 * kind.length(pulse);
  const auto reach = static_cast<int>(std::ceil(half / step));
  std::vector<Complex> taps;
  double energy = 0;
  for (int k = -reach; k <= reach; ++k) {
    const double covered = std::min((half - std::abs(k) * step) / step + 0.5, 1.0);
    if (covered <= 0) continue;
    const double t = std::clamp(k * step, -half, half);
    taps.push_back(std::polar(std::sqrt(covered) * replica_weight(pulse, t), -kind.phase(pulse, t, 0)));
    energy += std::norm(taps.back());
  }
  for (Complex& tap : taps) tap /= std::sqrt(energy);
  return taps;
}

/// Taps for a signal of a few bins, whose ends taps of the replica would miss: those of a filter whose power response is
/// the transform of the replica's autocorrelation at the bin spacing, with unit energy (E204).
std::vector<Complex> short_matched_filter(const MatchedPulse& kind, const Pulse& pulse, double step) {
  constexpr int frequencies = 128, parts = 1000;
  const double length = kind.length(pulse);
  const auto replica = [&](double t) { return std::polar(replica_weight(pulse, t), kind.phase(pulse, t, 0)); };
  std::vector<Complex> correlation;
  for (double lag = 0; lag < length; lag += step) {
    correlation.emplace_back(0);
    const double overlap = length - lag;
    for (int k = 0; k < parts; ++k) {
      const double t = 0.5 * length - (k + 0.5) / parts * overlap;
      correlation.back() += overlap * replica(t) * std::conj(replica(t - lag));
    }
  }
  std::vector<Complex> taps(frequencies - 1);
  for (int j = 0; j < frequencies; ++j) {
    const double turn = 2 * pi * j / frequencies;
    double power = 1;
    for (std::size_t l = 1; l < correlation.size(); ++l)
      power += 2 * (correlation[l] * std::polar(1 / correlation[0].real(), -turn * static_cast<double>(l))).real();
    for (std::size_t k = 0; k < taps.size(); ++k)
      taps[k] += std::polar(std::sqrt(std::max(0.0, power)) / frequencies,
                            -turn * (static_cast<double>(k) - frequencies / 2 + 1));  // (E204)
  }
  return taps;
}

}  // namespace

ReceiveFilter::ReceiveFilter(const Pulse& pulse, double step) {
  if (const MatchedPulse* const matched = kind_of(pulse).matched())
    complex = matched->length(pulse) < few_bins * step ? short_matched_filter(*matched, pulse, step)
                                                       : matched_filter(*matched, pulse, step);
  else
    real = gaussian_filter(pulse, step);
}

}  // namespace insonify
