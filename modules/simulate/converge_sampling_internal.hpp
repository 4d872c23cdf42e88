#pragma once
#include <string>
#include <vector>

#include "simulate/resolve_ping.hpp"
#include "simulate/simulated_ping.hpp"

namespace insonify {

/// Samples what the head sees: once as ping.view says, or, if the options ask for a level error, so finely that the
/// expected level of 99 % of the judged cells has a standard error below it (E66).
///
/// Cells are judged within 40 dB of the strongest of the direct echoes, without speckle, multipath and refraction.
/// Split surfels and jittered rays do better than the independent points of E66 (on a plane the standard deviation of
/// levels over 20 seeds was 0.4 and 0.12 of the prediction): more points are taken than the error needs.
///
/// Leaves the sampling that was used in ping.view.sampling, and how it was reached in `report`. Another sampling is
/// another realisation of the speckle. Throws Error as find_scatterers, direct_echoes and predict_level_error_db do.
Sampling sample_view(const PreparedScene& prepared, ResolvedPing& ping, ConvergenceReport& report);

/// One sentence with a remedy if the wanted error was not reached; else none.
std::vector<std::string> convergence_notes(const ConvergenceReport& report);

}  // namespace insonify
