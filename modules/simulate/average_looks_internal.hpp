#pragma once
#include "simulate/resolve_ping.hpp"
#include "simulate/simulate_ping.hpp"

namespace insonify {

/// Gives the ping the intensity of its looks (E71), if the options ask for more than one: its own and that of further
/// pulses with seeds of their own, averaged over pulses and bins.
void average_looks(const PreparedScene& prepared, const ResolvedPing& ping, SimulatedPing& result);

}  // namespace insonify
