#pragma once
#include <memory>
#include <span>

#include "scene/material.hpp"
#include "simulate/resolve_ping.hpp"

namespace insonify {

/// Returns the energy that a head receives from surfels (E127): cross-section and patterns of its echo (E7), spreading and absorption;
/// for a head of one beam also the mean of the array's response over a beam width to either side, since parts stand
/// beside the surfel's middle and side lobes have nulls. A fan compares what lies in one direction in u only. Empty where
/// parts must be as many as cells ask for: several rows of beams, rays, coherent amplitudes, echoes from other directions
/// than their surfels' (options.lobe_margin = 2), no splitting.
std::shared_ptr<const SurfelEnergy> surfel_energy(const ResolvedPing& ping, std::span<const Material> materials);

}  // namespace insonify
