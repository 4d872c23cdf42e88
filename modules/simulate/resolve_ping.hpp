// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>

#include "acoustics/environment.hpp"
#include "acoustics/fit_shapes.hpp"
#include "acoustics/multipath_echoes.hpp"
#include "sampling/insonified_region.hpp"
#include "scene/scene_cloud.hpp"
#include "simulate/ping_event.hpp"
#include "simulate/simulation_options.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// A ping and all that follows from its head, event, environment and options, derived once for every stage.
struct ResolvedPing {
  SonarHead head;
  PingEvent event;
  Environment environment;  ///< its water is that at the head's own depth (environment_at)
  SimulationOptions options;
  Transmission sent{};          ///< pulse, medium and the patterns that echoes are weighted by; surfaces: those of the
                                ///< scene that is pinged, once it is known
  View view{};                  ///< pose, fan, sampled ranges and sampling
  InsonifiedRegion region{};    ///< all that can be received or block sound; with multipath a ball about the head. It
                                ///< includes what effects that are still open may need
  SmoothShapes smooth{};        ///< mirrors of the environment; once the scene is known (find_smooth) all that reflects
                                ///< as a whole
  bool smooth_scene = false;    ///< WholeScene::smooth
  double element_noise_db = 0;  ///< of all noise in the band, at an element [dB re 1 uPa]
  double beam_noise_db = 0;     ///< of the same in a beam: less the array's gain (E19)
  /// Of each surfel of the scene that is pinged, its index in the scene that was given (SceneCut); empty: the same.
  std::span<const std::uint32_t> stands_for{};
  DetectionOptions detection{};  ///< with that noise floor and the pulse's resolution, if the options leave them open
};

/// Whether a beam has another main lobe in a direction that there is: elements are too far apart for this wavelength
/// [m].
bool has_further_lobes(const SonarHead& head, double wavelength);

/// SamplingOptions::lobe_margin that holds all directions.
inline constexpr double lobes_everywhere = 2;

/// Sampling of what counts as in view: main lobes with their margin, and elevations above the floor of the pattern.
SamplingOptions sampling_in_view(const ResolvedPing& ping);

/// Whether a ping of a scene merges surfels: SamplingSettings::detail_width, where scene and outputs allow it.
bool merges_surfels(const SceneCloud& scene, const SimulationOptions& options);

/// Whether sound can come by way of a surface or bottom.
bool has_boundary(const Environment& environment);

/// Whether a scene or its environment has what reflects as a whole.
bool may_mirror(const Environment& environment, bool smooth_scene);

/// Adds to ping.smooth the shapes of smooth materials within the ping's region, unless mirrors are off.
void find_smooth(const SceneCloud& scene, ResolvedPing& ping);

/// Range [m] within which surfels may take part in echoes by way of boundaries and mirrors; 0: there are none, or their
/// effects are off.
double reach_of_legs(const ResolvedPing& ping);

/// Resolves a ping of a scene with the properties `scene` (whole_of, PreparedScene::whole), for plan_ping,
/// simulate_ping and all that asks what a ping would see. The surfels inside `region` alone, in their order and with
/// SceneCloud::part_of set, give the same ping to the byte.
///
/// The sampled ranges go beyond the head's gate as far as pulses reach into it (down to half the tolerance) and as
/// parts of the largest surfel stand off its middle; never below 0.1 m, or the gate's own beginning if that is nearer.
///
/// Throws Error for an invalid head, event, environment or option, for a head at or above the surface and what else
/// environment_at refuses, for multipath without a boundary and for mirrors without any; `who` names the caller.
ResolvedPing resolve_ping(const WholeScene& scene, const SonarHead& head, const PingEvent& event,
                          const Environment& environment, const SimulationOptions& options = {},
                          const char* who = "resolve_ping");

/// Throws Error(argument) for an invalid head or option, and for multipath without a boundary.
void require_valid(const SonarHead& head, const Environment& environment, const SimulationOptions& options,
                   const char* who);

/// Derives again all that follows from ping.options.
void derive(const WholeScene& scene, ResolvedPing& ping);

}  // namespace insonify
