// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "simulate/simulation_options.hpp"

namespace insonify {

/// Returns how far shadows reach beyond the rays over the upper edges of plates [cells of range], one number for each
/// of eight plates and each beam within 10 degrees ahead, ascending by size; negative where the shadow ends too early.
///
/// The plates of 0.8 to 1.01 m stand 5 m ahead on level ground, 3 m below the head, as surfels 2 cm apart. A shadow
/// ends where the expected energy reaches that of the bare ground. `sampling` merges surfels or does not. If `large`,
/// nodes at silhouettes are not divided, as in a scene of a million surfels (E172).
std::vector<double> shadow_edge_errors(const SamplingSettings& sampling, bool large = false);

}  // namespace insonify
