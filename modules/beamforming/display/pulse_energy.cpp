// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <complex>

#include "beamforming/display/pulse_energy_internal.hpp"
#include "core/units.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
namespace {

constexpr double samples_per_period = 6;  // of the bandwidth
constexpr int least_of_corners = 24;      // samples on either side of a pulse with corners: 0.1 % of its energy
constexpr double most_periods = 48;       // side lobes of a sweep beyond these hold less than 1e-3 of its energy
constexpr double cut = 1e-4;              // of the envelope

}  // namespace

PulseEnergy::PulseEnergy(const Pulse& pulse, const Medium& medium, const RangeGate& gate)
    : pulse_(pulse), medium_(medium), shapes_(pulse, medium), first_range_(gate.min_range) {
  const double metres_per_s = 0.5 * medium.sound_speed;
  fill_energies(gate, metres_per_s);

  // Length and correlation in the middle of the gate.
  const Samples g = samples_of(0.5 * (gate.min_range + gate.max_range));
  double energy = 0, spread = 0;
  for (std::size_t k = 0; k < g.value.size(); ++k) {
    const double away = (static_cast<double>(k) - 0.5 * static_cast<double>(g.value.size() - 1)) * g.step;
    energy += std::norm(g.value[k]), spread += std::norm(g.value[k]) * away * away;
  }
  half_length_ = energy > 0 ? metres_per_s * std::sqrt(3 * spread / energy) : 0;
  correlation_step_ = g.step * metres_per_s;
  for (std::size_t lag = 0; lag < g.value.size(); ++lag) {
    std::complex<double> sum = 0;
    for (std::size_t k = 0; k + lag < g.value.size(); ++k) sum += g.value[k] * std::conj(g.value[k + lag]);
    correlation_.push_back(energy > 0 ? std::norm(sum / energy) : lag == 0);
    if (correlation_.back() < 1e-6) break;
  }
}

PulseEnergy::Samples PulseEnergy::samples_of(double range) const {
  const double reach = std::min(pulse_half_length(pulse_, cut), most_periods / pulse_.bandwidth);
  const EchoEnvelope envelope = shapes_.of(2 * range / medium_.sound_speed);
  auto half = static_cast<int>(std::ceil(reach * samples_per_period * pulse_.bandwidth));
  if (!is_gaussian(pulse_)) half = std::max(half, least_of_corners);
  Samples samples{{}, reach / half};
  for (int k = -half; k <= half; ++k) samples.value.push_back(envelope.at(k * samples.step));
  return samples;
}

void PulseEnergy::fill_energies(const RangeGate& gate, double metres_per_s) {
  // Between ranges at which the pulse is sampled, the logarithm of its energy is nearly straight; between the finer
  // entries of the table the energy itself is.
  const std::size_t sampled = is_gaussian(pulse_) ? 65 : 9, finer = 1024 / (sampled - 1);
  const double step = (gate.max_range - gate.min_range) / static_cast<double>(sampled - 1);
  entries_per_metre_ = static_cast<double>(finer) / step;
  std::vector<double> log_energy;
  for (std::size_t k = 0; k < sampled; ++k) {
    const Samples g = samples_of(first_range_ + static_cast<double>(k) * step);
    double energy = 0;
    for (const std::complex<double>& value : g.value) energy += std::norm(value);
    log_energy.push_back(std::log(std::max(energy * g.step * metres_per_s, 1e-300)));
  }
  for (std::size_t k = 0; k + 1 < sampled; ++k)
    for (std::size_t i = 0; i < finer; ++i)
      energy_.push_back(
          std::exp(std::lerp(log_energy[k], log_energy[k + 1], static_cast<double>(i) / static_cast<double>(finer))));
  energy_.push_back(std::exp(log_energy.back()));
}

double PulseEnergy::correlation(double distance) const {
  const double position = std::abs(distance) / correlation_step_;
  const auto left = static_cast<std::size_t>(position);
  if (left + 1 >= correlation_.size()) return 0;
  return std::lerp(correlation_[left], correlation_[left + 1], position - static_cast<double>(left));
}

std::vector<SpectrumNode> PulseEnergy::spectrum(double range, std::size_t count) const {
  const Samples g = samples_of(range);
  std::vector<SpectrumNode> nodes;
  double sum = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const double frequency =
        1.5 * pulse_.bandwidth * (2 * (static_cast<double>(n) + 0.5) / static_cast<double>(count) - 1);
    std::complex<double> at = 0;  // time dependence exp(-i omega t)
    for (std::size_t k = 0; k < g.value.size(); ++k)
      at += g.value[k] * std::polar(1.0, 2 * pi * frequency * static_cast<double>(k) * g.step);
    nodes.push_back({frequency, std::norm(at)});
    sum += nodes.back().weight;
  }
  for (SpectrumNode& node : nodes) node.weight = sum > 0 ? node.weight / sum : 1 / static_cast<double>(count);
  return nodes;
}

}  // namespace insonify
