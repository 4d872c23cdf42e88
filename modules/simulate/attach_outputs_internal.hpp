#pragma once
#include "acoustics/multipath_echoes.hpp"
#include "scene/prepared_scene.hpp"
#include "simulate/simulate_ping.hpp"

namespace insonify {

/// What a ping was made from, beside what its result holds.
struct PingParts {
  const View& view;
  const Environment& environment;
  const Echoes& direct;
  const Multipath& bounced;
};

/// Gives `result`, whose ping, medium and scatterers stand, what the options ask to keep beside the pressure: level error
/// and mask of holes, contributors (E63), paths of sound; and what to tell the user of its sampling.
void attach_outputs(const PreparedScene& prepared, const SonarHead& head, const PingParts& parts,
                    const SimulationOptions& options, SimulatedPing& result);

}  // namespace insonify
