#pragma once
#include <cstdint>
#include <vector>

#include "sampling/find_scatterers.hpp"
#include "sampling/gate_surfels_internal.hpp"

namespace insonify {

/// For each gated surfel 1 if another one hides it, else 0. Only those that could give an echo (in the gate
/// and facing the head) are looked at; the others stay 0. The projection (not automatic) changes the cost alone.
std::vector<std::uint8_t> find_hidden(const std::vector<GatedSurfel>& surfels, Projection projection, int threads);

}  // namespace insonify
