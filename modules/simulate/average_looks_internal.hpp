#pragma once
#include <functional>

#include "returns/ping.hpp"
#include "simulate/resolve_ping.hpp"

namespace insonify {

/// Gives a ping the intensity of its looks (E71), if its options ask for more than one: its own and that of further pulses
/// with seeds of their own, averaged over pulses and bins. `simulate` makes a pulse.
void average_looks(const ResolvedPing& resolved, Ping& ping, const std::function<Ping(const ResolvedPing&)>& simulate);

}  // namespace insonify
