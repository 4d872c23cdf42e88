// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "beamforming/synthesize.hpp"
#include "sonar/receive_array.hpp"

namespace insonify {

/// Throws Error unless head, medium, echoes and options are valid for synthesis; a NaN is reported with the index of
/// its echo.
void require_synthesis(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                       const SynthesisOptions& options, const char* who);

/// Throws Error with its index for an echo that is not finite.
void require_finite(const Echoes& echoes, const char* who);

/// Throws Error unless the head has one row of beams and no column and, with `of_line`, its array is a line.
void require_one_row(const SonarHead& head, const char* who, bool of_line = true);

/// Returns the direction from which echo `i` arrives; v counts as 0 if the echoes have none.
inline Eigen::Vector3d direction_of_echo(const Echoes& echoes, std::size_t i) {
  return ahead(echoes.u[i], echoes.v.empty() ? 0 : echoes.v[i]);
}

/// Returns the direction cosine of every beam along the array: cos(elevation) sin(azimuth).
std::vector<double> beam_cosines(const BeamFan& fan);

}  // namespace insonify
