#pragma once
#include "acoustics/multipath_echoes.hpp"
#include "simulate/resolve_ping.hpp"
#include "simulate/simulate_ping.hpp"

namespace insonify {

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
