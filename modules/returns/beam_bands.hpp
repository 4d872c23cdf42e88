// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

#include "returns/pixel_labels.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// Bands of beams, [first, end) each.
using BeamBands = std::vector<std::pair<std::size_t, std::size_t>>;

/// Returns bands of whole rows of beams. The contributors of a band (`per_pixel` of each pixel) fit into `mib` [MiB]
/// together. A band has at least two rows, because labels need the step between rows. Returns one band if the rows do
/// not follow each other.
BeamBands beam_bands(const SonarHead& head, int per_pixel, double mib);

/// Returns the head with the beams [first, end) alone.
SonarHead with_beams(const SonarHead& head, std::size_t first, std::size_t end);

/// Copies the labels of a band of beams into those of all `beams`.
void put_labels(PixelLabels band, std::size_t first_beam, std::size_t beams, PixelLabels& all);

}  // namespace insonify
