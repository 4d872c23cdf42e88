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
  Transmission sent{};          ///< pulse, medium and the patterns that weight echoes; surfaces: those of the pinged
                                ///< scene, once it is known
  View view{};                  ///< pose, fan, sampled ranges and sampling
  InsonifiedRegion region{};    ///< place of all surfels that can be received or block sound, also for effects that are
                                ///< not yet decided; with multipath a ball about the head
  SmoothShapes smooth{};        ///< mirrors of the environment, and, once the scene is known (find_smooth), its shapes
                                ///< that reflect as one body
  bool smooth_scene = false;    ///< WholeScene::smooth
  double element_noise_db = 0;  ///< level of all noise in the band, at an element [dB re 1 uPa]
  double beam_noise_db = 0;     ///< level of all noise in a beam: element_noise_db less the array's gain (E19)
  RangeGate samples{};          ///< the gate of the samples; head.gate is that of display cells where these are drawn
  /// Index in the given scene of each surfel of the pinged scene (SceneCut); empty: both are the same.
  std::span<const std::uint32_t> stands_for{};
  DetectionOptions detection{};  ///< defaults: noise floor of beam_noise_db, resolution of the pulse
};

/// Sets a method that serves the array of the head, unless true delays are still to be decided: of the model asked for.
void serve_array(const SonarHead& head, SimulationOptions& options);

/// Returns whether a beam has a second main lobe in a real direction, because elements are too far apart for this
/// wavelength [m].
bool has_further_lobes(const SonarHead& head, double wavelength);

/// Value of SamplingOptions::lobe_margin that includes all directions.
inline constexpr double lobes_everywhere = 2;

/// Returns the sampling of the directions in view: main lobes with their margin, and elevations above the floor of the
/// pattern.
SamplingOptions sampling_in_view(const ResolvedPing& ping);

/// Returns whether display cells are drawn (E180), instead of being means of samples.
inline bool draws_cells(const SimulationOptions& options) {
  return options.outputs.display_bins > 0 && !options.synthesis.phases;
}

/// Returns whether a ping of a scene merges surfels: SamplingSettings::detail of the resolved options says so, and
/// scene and outputs allow it.
bool merges_surfels(const SceneCloud& scene, const SimulationOptions& options);

/// Returns whether the environment has a surface or bottom that can reflect sound.
bool has_boundary(const Environment& environment);

/// Returns whether a scene or its environment has mirrors or other shapes that reflect as one body.
bool may_mirror(const Environment& environment, bool smooth_scene);

/// Adds to ping.smooth the shapes of smooth materials within the ping's region, unless mirrors are off.
void find_smooth(const SceneCloud& scene, ResolvedPing& ping);

/// Returns the range [m] within which surfels may take part in echoes by way of boundaries and mirrors; 0 if there are
/// none, or their effects are off.
double reach_of_legs(const ResolvedPing& ping);

/// Resolves a ping of a scene with the properties `scene` (whole_of, PreparedScene::whole). plan_ping, simulate_ping
/// and all other functions that need the view of a ping use it. The surfels inside `region` alone, in their order and
/// with SceneCloud::part_of set, give the same ping to the byte.
///
/// The sampled ranges extend beyond the head's gate by the length of pulses that reach into it (down to half the
/// tolerance) and by the radius of the largest surfel. They begin at 0.1 m or farther, or at the gate's own beginning
/// if that is nearer.
///
/// Throws Error for an invalid head, event, environment or option, for a head at or above the surface and other cases
/// that environment_at refuses, for multipath without a boundary, and for mirrors without any mirror; `who` names the
/// caller.
ResolvedPing resolve_ping(const WholeScene& scene, const SonarHead& head, const PingEvent& event,
                          const Environment& environment, const SimulationOptions& options = {},
                          const char* who = "resolve_ping");

/// Throws Error(argument) for an invalid head or option, and for multipath without a boundary.
void require_valid(const SonarHead& head, const Environment& environment, const SimulationOptions& options,
                   const char* who);

/// Derives again all that follows from ping.options.
void derive(const WholeScene& scene, ResolvedPing& ping);

}  // namespace insonify
