// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {

ReplicaWeights MatchedPulse::weights(const Pulse& pulse) const {
  if (pulse.window == ReplicaWindow::hann) return {0.5, 0.5};
  if (pulse.window == ReplicaWindow::hamming) return {0.54, 0.46};
  return {1, 0};
}

std::vector<std::complex<double>> MatchedPulse::samples(const Pulse& pulse, std::size_t count, double step,
                                                        bool weighted, double doppler) const {
  std::vector<std::complex<double>> x(count, 0);
  const double half = 0.5 * arriving_length(pulse, doppler);
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(half / step));
  for (std::ptrdiff_t n = -reach; n <= reach; ++n) {
    const double t = static_cast<double>(n) * step;
    const double covered = std::clamp((half - std::abs(t)) / step + 0.5, 0.0, 1.0);
    const double weight = weighted ? replica_weight(pulse, t) : 1;
    x[static_cast<std::size_t>(n > 0 ? static_cast<std::ptrdiff_t>(count) - n : -n)] =
        std::polar(covered * weight * step, phase(pulse, t, doppler));
  }
  return x;
}

double MatchedPulse::range_resolution(const Pulse& pulse, double sound_speed) const {
  const EchoEnvelope echo = echo_envelope(pulse, {}, 0);
  const auto above = [&](double t) { return std::norm(echo.at(t)) > 0.5; };
  // Find the first step below half the peak, then bisect.
  const double step = 0.02 / pulse.bandwidth;
  double inside = 0, outside = step;
  while (above(outside)) inside = outside, outside += step;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (inside + outside);
    (above(middle) ? inside : outside) = middle;
  }
  return sound_speed * outside;  // (E55)
}

double MatchedPulse::energy_length(const Pulse& pulse, double sound_speed) const {
  constexpr double samples = 8, most_periods = 200;  // side lobes beyond hold less than 1e-3 of the energy
  const EchoEnvelope echo = echo_envelope(pulse, {}, 0);
  const double reach = std::min(end(pulse), most_periods / pulse.bandwidth), step = 1 / (samples * pulse.bandwidth);
  double energy = 1;
  for (double t = step; t < reach; t += step) energy += 2 * std::norm(echo.at(t));
  return 0.5 * sound_speed * energy * step;
}

double MatchedPulse::half_length(const Pulse& pulse, double tolerance) const {
  const double duration = length(pulse), main_lobe = 2 / pulse.bandwidth;
  const auto [level, swing] = weights(pulse);
  // Behind the main lobe the envelope comes from the two ends of the overlap: that of the replica on one side and that
  // of the echo on the other, where the replica's weight is that at T/2 - t.
  const auto bound = [&](double t) {
    const double f = pulse.bandwidth * t / duration, h = 1 / duration;
    const std::complex<double> turn = std::polar(1.0, 2 * pi * t / duration);
    const double replica_end = std::abs(level / f - swing * f / (f * f - h * h));
    const double echo_end = std::abs(level / f - 0.5 * swing * (std::conj(turn) / (f - h) + turn / (f + h)));
    return (replica_end + echo_end) / (2 * pi * level * duration);
  };
  constexpr int steps = 4096;
  if (main_lobe >= duration) return duration;
  for (int n = steps; n > 0; --n) {
    const double t = main_lobe * std::pow(duration / main_lobe, static_cast<double>(n - 1) / steps);
    if (bound(t) > tolerance)
      return std::min(duration, main_lobe * std::pow(duration / main_lobe, static_cast<double>(n) / steps));
  }
  return main_lobe;
}

double MatchedPulse::noise_bandwidth(const Pulse& pulse) const {
  const auto [level, swing] = weights(pulse);
  return (1 + 0.5 * (swing * swing) / (level * level)) / length(pulse);  // (E55)
}

double MatchedPulse::relative_band(const Pulse& pulse, double) const {
  return 0.5 + 4 / std::sqrt(pulse.bandwidth * length(pulse));
}

SpectrumMoments MatchedPulse::moments(const Pulse& pulse) const { return {0, pulse.bandwidth * 0.288675134595}; }

double least_absorption(const Absorption& a, double edge, const Pulse& pulse) {
  double least = std::min(a.a0 - a.a1 * edge, a.a0 + a.a1 * edge) + a.a2 * edge * edge;
  const double lowest = a.a2 > 0 ? -a.a1 / (2 * a.a2) : 2 * edge;
  if (std::abs(lowest) < edge) least = a.a0 - a.a1 * a.a1 / (4 * a.a2);
  if (!(least >= -1e-9 * a.a0))
    fail(ErrorKind::argument, "echo_envelope: absorption slope ", a.a1, " Np/m/Hz and curvature ", a.a2,
         " Np/m/Hz^2 turn a sweep over ", pulse.bandwidth,
         " Hz into a growing one; use absorption order 0, or a smaller bandwidth");
  return least;
}

}  // namespace insonify
