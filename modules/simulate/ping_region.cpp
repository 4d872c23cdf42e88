#include "simulate/ping_region.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/stage_options_internal.hpp"

namespace insonify {
namespace {

/// Farthest that a surfel can stand and still reflect or block a leg by a boundary: no leg is longer than the mean of
/// two by more than the head's distance from the farther boundary.
double radius_of_paths(const View& view, const Environment& environment, const Pulse& pulse, double sound_speed) {
  constexpr double pulse_floor = 1e-4, rounding = 1.001;
  const double head = view.world_from_head.translation().z();
  double farthest = 0;
  if (environment.surface) farthest = std::max(farthest, std::abs(head - environment.surface->height));
  if (environment.bottom) farthest = std::max(farthest, std::abs(head - environment.bottom->height));
  return rounding * (view.gate.max_range + 0.5 * sound_speed * pulse_half_length(pulse, pulse_floor) + farthest);
}

}  // namespace

InsonifiedRegion ping_region(const WholeScene& whole, const SonarHead& head, const Pose& world_from_head,
                             const Environment& environment, const SimulationOptions& options) {
  require_valid(head, "ping_region");
  require_valid(environment, "ping_region");
  const Medium medium = medium_of(environment, head.pulse.centre_frequency, options.absorption_order);
  const View view = view_of(whole.largest_area, head, world_from_head, medium, options);
  if (options.multipath) {
    InsonifiedRegion region = region_around(world_from_head.translation(),
                                            radius_of_paths(view, environment, head.pulse, medium.sound_speed));
    region.footprint = view.sampling.footprint;
    return region;
  }
  const SamplingOptions& s = view.sampling;
  const double half_extent = s.elevation_half_extent > 0 ? s.elevation_half_extent : view.fan.elevation_width;
  return {world_from_head, insonified_sector(view.fan, half_extent, s.azimuth_margin), view.gate, s.footprint};
}

}  // namespace insonify
