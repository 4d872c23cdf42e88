// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <span>

#include "scene/material.hpp"
#include "simulate/resolve_ping.hpp"

namespace insonify {

/// Returns the energy that a head receives from surfels (E127): cross-section, patterns, spreading and absorption of
/// the echo (E7). For a head of one beam it includes the array's response, averaged over a beam width to either side,
/// since side lobes have nulls and parts stand beside the surfel's middle. Empty where energy may not decide the number
/// of parts: several rows of beams, rays, coherent amplitudes, echoes that arrive from elsewhere (options.lobe_margin =
/// 2), no splitting.
std::shared_ptr<const SurfelEnergy> surfel_energy(const ResolvedPing& ping, std::span<const Material> materials);

}  // namespace insonify
