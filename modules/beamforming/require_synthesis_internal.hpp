#pragma once
#include <vector>

#include "beamforming/synthesize.hpp"

namespace insonify {

/// Throws Error unless head, medium, echoes and options can be synthesized; a NaN is named by its echo.
void require_synthesis(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                       const SynthesisOptions& options, const char* who);

/// Throws Error unless head has one row of beams and no column, as the synthesizers of line arrays need it.
void require_one_row(const SonarHead& head, const char* who);

/// Direction cosine along the array of every beam: cos(elevation) sin(azimuth).
std::vector<double> beam_cosines(const BeamFan& fan);

}  // namespace insonify
