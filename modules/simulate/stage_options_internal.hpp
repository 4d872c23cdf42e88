#pragma once
#include <string>
#include <vector>

#include "scene/prepared_scene.hpp"
#include "simulate/simulate_ping.hpp"

/// What each stage of simulate_ping needs to be told, from head, medium and the options of the ping.
namespace insonify {

SamplingOptions sampling_options(const SonarHead& head, const Medium& medium, const SimulationOptions& options);
EchoOptions echo_options_of(const SonarHead& head, const SimulationOptions& options);
/// A noise floor of -inf becomes that of all noise in the band, less the array's gain.
DetectionOptions detection_options(const SonarHead& head, const Environment& environment,
                                   const SimulationOptions& options);

/// Of one surfel [m^2], of the whole scene if this is a part of it; 0 without surfels.
double largest_area(const SceneCloud& scene);

/// The ranges that are sampled: the head's gate, and to either side as far as pulses reach into it and parts of surfels of
/// `largest_area` stand off their middles; never below 0.1 m, or the gate's own beginning if that is nearer.
RangeGate sampled_gate(double largest_area, const SonarHead& head, const Medium& medium,
                       const SimulationOptions& options);

/// Where the head looks in a scene of surfels up to `largest_area`, and how.
View view_of(double largest_area, const SonarHead& head, const Pose& world_from_head, const Medium& medium,
             const SimulationOptions& options);

/// Bends the rays to the scatterers if asked for, or if straight ones would be off by a range bin, or by an angle that the
/// elevation pattern feels; says what was done.
RefractionReport refract(const Environment& environment, const View& view, Choice choice, double bin_size,
                         Scatterers& scatterers);

/// Echoes of water and boundaries themselves, one entry for each that the environment calls for.
struct Reverberation {
  const char* name;
  Echoes echoes;
};
std::vector<Reverberation> reverberation_echoes(const Environment& environment, const View& view,
                                                const Transmission& transmission, std::int64_t ping);

}  // namespace insonify
