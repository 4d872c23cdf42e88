#pragma once
#include "simulate/resolve_ping.hpp"

/// The steps of resolve_ping, for pings of one head that is checked once.
namespace insonify {

/// Throws Error(argument) for an invalid head or option, and for multipath without a boundary.
void require_valid(const SonarHead& head, const Environment& environment, const SimulationOptions& options,
                   const char* who);

/// resolve_ping of a head and options that are valid.
ResolvedPing resolve_valid_ping(const WholeScene& scene, const SonarHead& head, const PingEvent& event,
                                const Environment& environment, const SimulationOptions& options, const char* who);

/// Derives again all that follows from ping.options.
void derive(const WholeScene& scene, ResolvedPing& ping);

}  // namespace insonify
