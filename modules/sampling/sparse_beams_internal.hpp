// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "sampling/gate_surfels_internal.hpp"

namespace insonify {

/// Returns the number of beams most of whose view, by solid angle, consists of surfels so large that a main lobe at
/// their range holds fewer than four: their level is then off by 2 dB and more, or they fall between surfels. Surfels
/// that are hidden count too.
std::size_t count_sparse_beams(const GatedSurfels& surfels, const BeamFan& fan, const RangeGate& gate, int threads);

}  // namespace insonify
