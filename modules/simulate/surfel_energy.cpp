// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "simulate/received_energy.hpp"
#include "simulate/surfel_energy_internal.hpp"

namespace insonify {
namespace {

/// Squared gain over v = sin(elevation), between entries of a table: the sines of a pattern would cost more than the
/// echo.
class ElevationGains {
 public:
  explicit ElevationGains(const EchoOptions& sent) {
    for (std::size_t k = 0; k < squared_.size(); ++k)
      squared_[k] = std::pow(elevation_pattern(sent, std::asin(2.0 * static_cast<double>(k) / (entries - 1) - 1)), 2);
  }
  double squared(double v) const {
    const double position = 0.5 * (std::clamp(v, -1.0, 1.0) + 1) * (entries - 1);
    const std::size_t left = std::min(static_cast<std::size_t>(position), squared_.size() - 2);
    return squared_[left] + (position - static_cast<double>(left)) * (squared_[left + 1] - squared_[left]);
  }

 private:
  static constexpr int entries = 4097;
  std::array<double, entries> squared_;
};

class EchoEnergy final : public SurfelEnergy {
 public:
  EchoEnergy(const ResolvedPing& ping, std::span<const Material> materials)
      : sent_(ping.sent.echo_options),
        gains_(sent_),
        surfaces_(surfaces_of(ping.sent, materials)),
        absorption_(ping.sent.medium.absorption.a0) {
    const BeamFan& fan = ping.head.fan;
    if (fan.beams() == 1)
      response_.emplace(ping.head, ping.sent.medium.sound_speed / ping.head.pulse.centre_frequency,
                        fan.beam_width + ping.view.sampling.lobe_margin);
  }

  double of(const Eigen::Vector3d& p, double cosine, double area, std::size_t material) const override {
    const double range = p.norm();
    const double sent_there = sent_.transmit_width > 0 ? transmit_pattern(sent_, std::atan2(p.y(), p.x())) : 1;
    const double sigma = cross_section(*surfaces_[material], {cosine, cosine, area * cosine});
    return sigma * gains_.squared(p.z() / range) * sent_there * sent_there * std::exp(-4 * absorption_ * range) /
           (range * range * range * range) * (response_ ? response_->along_array(p.y() / range) : 1);  // (E7, E10)
  }

 private:
  EchoOptions sent_;
  ElevationGains gains_;
  SurfaceTable surfaces_;
  double absorption_;
  std::optional<ReceivedEnergy> response_;
};

}  // namespace

std::shared_ptr<const SurfelEnergy> surfel_energy(const ResolvedPing& ping, std::span<const Material> materials) {
  const SamplingOptions& sampling = ping.view.sampling;
  const BeamFan& fan = ping.head.fan;
  const auto keeps_phase = [](const Material& m) { return m.coherent_fraction > 0; };
  const bool coherent = ping.sent.echo_options.amplitude == SurfaceAmplitude::coherent ||
                        std::any_of(materials.begin(), materials.end(), keeps_phase);
  if (fan_rows(fan).size() > 1 || fan.row_width > 0 || ping.head.column || coherent ||
      sampling.kind != SamplingKind::surfels || sampling.lobe_margin >= lobes_everywhere ||
      !(sampling.scatterers_per_cell > 0))
    return nullptr;
  return std::make_shared<const EchoEnergy>(ping, materials);
}

}  // namespace insonify
