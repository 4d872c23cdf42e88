#include <algorithm>
#include <cmath>
#include <memory>

#include "acoustics/scattering.hpp"
#include "simulate/heard_energy_internal.hpp"
#include "simulate/received_energy_internal.hpp"

namespace insonify {

HeardEnergy heard_energy(const ResolvedPing& ping, std::span<const Material> materials) {
  const SamplingOptions& sampling = ping.view.sampling;
  const EchoOptions& sent = ping.sent.echo_options;
  const auto keeps_phase = [](const Material& m) { return m.coherent_fraction > 0; };
  const bool coherent =
      sent.amplitude == SurfaceAmplitude::coherent || std::any_of(materials.begin(), materials.end(), keeps_phase);
  if (ping.head.fan.beams() != 1 || ping.head.column || coherent || sampling.kind != SamplingKind::surfels ||
      sampling.lobe_margin >= 2 || !(sampling.scatterers_per_cell > 0))
    return nullptr;
  const double frequency = ping.head.pulse.centre_frequency, absorption = ping.sent.medium.absorption.a0;
  const auto response = std::make_shared<const ReceivedEnergy>(ping.head, ping.sent.medium.sound_speed / frequency,
                                                               ping.head.fan.beam_width + sampling.lobe_margin);
  return [response, materials, sent, frequency, absorption](const Eigen::Vector3d& p, double cosine, double area,
                                                            std::size_t material) {
    const double range = p.norm(), elevation = std::asin(std::clamp(p.z() / range, -1.0, 1.0));
    const double azimuth = sent.transmit_width > 0 ? std::atan2(p.y(), p.x()) : 0;
    const double gain = elevation_pattern(sent, elevation) * transmit_pattern(sent, azimuth);
    const double sigma = cross_section(materials[material], {cosine, cosine, area * cosine}, frequency);
    return sigma * gain * gain * std::exp(-4 * absorption * range) / (range * range * range * range) *
           response->along_array(p.y() / range);  // (E7, E10)
  };
}

}  // namespace insonify
