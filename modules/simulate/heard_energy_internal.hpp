#pragma once
#include <span>

#include "scene/material.hpp"
#include "simulate/resolve_ping.hpp"

namespace insonify {

/// Returns what the beam of a head of one beam receives of a surfel: cross-section and patterns of its echo (E7),
/// spreading, absorption, and the mean of the array's response over a beam width to either side, since parts stand
/// beside the surfel's middle and side lobes have nulls. Empty where parts must be as many as cells ask for: several
/// beams or rows, rays, coherent amplitudes, echoes from other directions than their surfels' (options.lobe_margin = 2),
/// no splitting.
HeardEnergy heard_energy(const ResolvedPing& ping, std::span<const Material> materials);

}  // namespace insonify
