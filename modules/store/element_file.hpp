// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "beamforming/reference/element_series.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// Writes the series of all elements as HDF5. The dataset /pressure holds elements x samples as compound {r, i} float32
/// [Pa], complex baseband. The root attributes are schema, start and step of the samples [s], spacing [m],
/// centre_frequency [Hz], sound_speed [m/s] and steering. steering is "exp(+2 pi i f y u / c)", the phase that steers a
/// plane-wave beam to the direction cosine u (+port). The file is written to a temporary name, then renamed. Throws
/// Error(argument) if the series does not fit the head, Error(content) if a sample exceeds single precision,
/// Error(file) if it cannot write.
void write_element_file(const std::string& path, const ElementSeries& series, const SonarHead& head,
                        double sound_speed);

}  // namespace insonify
