#pragma once
#include <vector>

#include "acoustics/multipath_echoes.hpp"
#include "simulate/resolve_ping.hpp"
#include "simulate/simulate_ping.hpp"

/// The stages of simulate_ping that are more than one call.
namespace insonify {

/// Bends the rays to the scatterers if the options, settled, say so. Without a profile nothing is done.
RefractionReport refract(const ResolvedPing& ping, Scatterers& scatterers);

/// Echoes of water and boundaries themselves, one entry for each that the environment calls for.
struct Reverberation {
  const char* name;
  Echoes echoes;
};
std::vector<Reverberation> reverberation_echoes(const ResolvedPing& ping);

/// What a ping was made of, for its outputs.
struct PingParts {
  Sampling sampling;
  const Echoes& direct;
  const Multipath& bounced;
};

/// Moves the sampling into `result`, whose ping is complete, and adds medium, noise floor and notes; and what the
/// options ask for: level error and mask of holes, contributors (E63), paths of sound.
void attach_outputs(const PreparedScene& prepared, const ResolvedPing& ping, PingParts parts, SimulatedPing& result);

}  // namespace insonify
