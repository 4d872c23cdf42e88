// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "acoustics/environment.hpp"
#include "returns/ping_note.hpp"
#include "simulate/simulated_ping.hpp"

namespace insonify {

/// Kind of the note of a ping that receives no surfel.
inline constexpr const char* silent_note_kind = "silent";

/// Returns all notes of a ping of a head with this gate: those of its report, that it is silent or sees nearly only
/// backs, why multipath gave no echo, and the effect of refraction.
std::vector<PingNote> notes_of(const SimulatedPing& ping, const Environment& environment, const RangeGate& gate);

}  // namespace insonify
