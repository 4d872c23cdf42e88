// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "core/pose.hpp"
#include "returns/contributors.hpp"
#include "returns/find_contributors.hpp"
#include "returns/pixel_labels.hpp"
#include "sampling/seen_surfels.hpp"
#include "scene/scene_cloud.hpp"
#include "sonar/sonar_head.hpp"
#include "sonar/water.hpp"

namespace insonify {

/// What a head sees of a scene, and what it does not see.
struct SeenSurface {
  const SurfelEchoes& direct;  ///< direct echoes of all visible parts
  const std::vector<Visibility>&
      others;               ///< one entry per surfel: of those without an echo whether they are hidden, turned
                            ///< away, or seen (by no ray); all else does not count
  const Contributors& all;  ///< of this ping, with their total energy
};

/// Labels the pixels of a ping (E125). The cell of a pixel is as wide as the half-power widths of pulse and beam (in
/// direction cosine; of planar arrays that of a row, too), and at least as a bin and the way to the next beams. Of the
/// materials with visible surface in the cell a pixel has the one with most energy there; of surfels of a part with a
/// label, that label stands for the material. Share: the energy of that
/// material within a whole width to either side, the main lobe, over the energy of all contributors. A cell without
/// visible surface is shadow if hidden surface or such that faces away lies in it. One with neither has the material of
/// the visible surfels within whose radius and main lobe it is, so that gaps between surfels have no label of their
/// own; else nothing. A part or an surfel without parts reaches by the radius of its area beyond its centre. Energies
/// are those of E63, without phases. Throws Error(argument) for contributors of another extent or without total, for
/// entries of another number than the scene's surfels, and as find_contributors.
PixelLabels label_pixels(const SceneCloud& scene, const SeenSurface& seen, const SonarHead& head,
                         const Pose& world_from_head, const Medium& medium, int threads = 0);

}  // namespace insonify
