#pragma once
#include <vector>

#include "simulate/resolve_ping.hpp"
#include "simulate/simulate_ping.hpp"

/// The stages of simulate_ping that are more than one call.
namespace insonify {

/// Bends the rays to the scatterers if asked for, or if straight ones would be off by a range bin, or by an angle that
/// the elevation pattern resolves. Without a profile nothing is done.
RefractionReport refract(const ResolvedPing& ping, Scatterers& scatterers);

/// Echoes of water and boundaries themselves, one entry for each that the environment calls for.
struct Reverberation {
  const char* name;
  Echoes echoes;
};
std::vector<Reverberation> reverberation_echoes(const ResolvedPing& ping);

}  // namespace insonify
