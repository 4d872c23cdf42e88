#include "acoustics/reverberation_echoes.hpp"
#include "simulate/ping_stages_internal.hpp"

namespace insonify {
namespace {

/// Part of the elevation width by which rays may bend without a change of the pattern's response.
constexpr double unresolved_bend = 0.02;

}  // namespace

RefractionReport refract(const ResolvedPing& ping, Scatterers& scatterers) {
  RefractionReport report;
  if (!ping.environment.profile) return report;
  const SoundSpeedProfile& profile = *ping.environment.profile;
  const double head_depth = ping.environment.water.depth;
  const Pose& pose = ping.view.world_from_head;
  const Choice choice = ping.options.effects.refraction;
  report.bound = refraction_bound(profile, head_depth, pose, scatterers);
  const bool needed = report.bound.range >= ping.head.gate.bin_size ||
                      report.bound.elevation >= unresolved_bend * ping.head.fan.elevation_width;
  report.bent = choice == Choice::always || (choice == Choice::as_needed && needed);
  if (report.bent) report.silenced = bend_paths(profile, head_depth, pose, scatterers, ping.options.threads);
  return report;
}

std::vector<Reverberation> reverberation_echoes(const ResolvedPing& ping) {
  const Environment& e = ping.environment;
  const auto& [pose, fan, gate, sampling] = ping.view;
  ReverberationOptions options;
  options.ping = ping.options.ping;
  std::vector<Reverberation> parts;
  if (e.volume_scattering_db) parts.push_back({"volume", volume_echoes(e, fan, gate, ping.sent, options)});
  if (e.surface && e.surface->scattering_strength_db)
    parts.push_back({"surface", surface_echoes(e, pose, fan, gate, ping.sent, options)});
  if (e.bottom && e.bottom->lambert_mu)
    parts.push_back({"bottom", bottom_echoes(e, pose, fan, gate, ping.sent, options)});
  return parts;
}

}  // namespace insonify
