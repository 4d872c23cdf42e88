// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "beamforming/synthesize_cells.hpp"
#include "returns/pixel_labels.hpp"
#include "sampling/insonified_region.hpp"
#include "scene/prepared_scene.hpp"

namespace insonify {

/// Returns the number of the label of each of these surfels, as label_pixels numbers them: an index into the names that
/// labels_of_cells gives.
std::vector<std::uint16_t> label_numbers(const SceneCloud& scene, std::span<const std::uint32_t> surfels);

/// Returns the labels of display cells (E194, E195), without shadow. Shares are rounded to 1/64 and elevations to
/// 1/512 rad, which a cube packs well.
///
/// surfels   indices in the scene of the surfels of the echoes whose numbers `cells` holds
/// sines     sines of the elevations from which these echoes arrive, head axes
PixelLabels labels_of_cells(const SceneCloud& scene, const CellLabels& cells, std::span<const std::uint32_t> surfels,
                            std::span<const double> sines);

/// Marks as shadow the cells of `labels` that have no label and hold surfels that the head does not see.
///
/// region   region of the view; surfels outside its sector or beyond its gate do not count
/// seen     one entry per surfel of the scene: 1 if the head sees it
/// head     its gate has the cells
void mark_shadow(const PreparedScene& prepared, const InsonifiedRegion& region, const std::vector<std::uint8_t>& seen,
                 const SonarHead& head, int threads, PixelLabels& labels);

}  // namespace insonify
