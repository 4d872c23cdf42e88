#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "acoustics/scattering.hpp"
#include "simulate/heard_energy_internal.hpp"
#include "simulate/received_energy_internal.hpp"

namespace insonify {
namespace {

/// Squared gain over v = sin(elevation), between entries of a table: the sines of a pattern would cost more than the echo.
class ElevationGains {
 public:
  explicit ElevationGains(const EchoOptions& sent) {
    for (std::size_t k = 0; k < squared_.size(); ++k)
      squared_[k] = std::pow(elevation_pattern(sent, std::asin(2.0 * static_cast<double>(k) / (entries - 1) - 1)), 2);
  }
  double squared(double v) const {
    const double place = 0.5 * (std::clamp(v, -1.0, 1.0) + 1) * (entries - 1);
    const std::size_t left = std::min(static_cast<std::size_t>(place), squared_.size() - 2);
    return squared_[left] + (place - static_cast<double>(left)) * (squared_[left + 1] - squared_[left]);
  }

 private:
  static constexpr int entries = 4097;
  std::array<double, entries> squared_;
};

}  // namespace

HeardEnergy heard_energy(const ResolvedPing& ping, std::span<const Material> materials) {
  const SamplingOptions& sampling = ping.view.sampling;
  const EchoOptions& sent = ping.sent.echo_options;
  const BeamFan& fan = ping.head.fan;
  const auto keeps_phase = [](const Material& m) { return m.coherent_fraction > 0; };
  const bool coherent =
      sent.amplitude == SurfaceAmplitude::coherent || std::any_of(materials.begin(), materials.end(), keeps_phase);
  if (fan_rows(fan).size() > 1 || fan.row_width > 0 || ping.head.column || coherent ||
      sampling.kind != SamplingKind::surfels || sampling.lobe_margin >= lobes_everywhere ||
      !(sampling.scatterers_per_cell > 0))
    return nullptr;
  const double frequency = ping.head.pulse.centre_frequency, absorption = ping.sent.medium.absorption.a0;
  const auto gains = std::make_shared<const ElevationGains>(sent);
  std::shared_ptr<const ReceivedEnergy> response;
  if (fan.beams() == 1)
    response = std::make_shared<const ReceivedEnergy>(ping.head, ping.sent.medium.sound_speed / frequency,
                                                      fan.beam_width + sampling.lobe_margin);
  return [gains, response, materials, sent, frequency, absorption](const Eigen::Vector3d& p, double cosine, double area,
                                                                   std::size_t material) {
    const double range = p.norm();
    const double sent_there = sent.transmit_width > 0 ? transmit_pattern(sent, std::atan2(p.y(), p.x())) : 1;
    const double sigma = cross_section(materials[material], {cosine, cosine, area * cosine}, frequency);
    return sigma * gains->squared(p.z() / range) * sent_there * sent_there * std::exp(-4 * absorption * range) /
           (range * range * range * range) * (response ? response->along_array(p.y() / range) : 1);  // (E7, E10)
  };
}

}  // namespace insonify
