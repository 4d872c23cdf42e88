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

/// The surface of a scene that a head sees, and the surface that it does not see.
struct SeenSurface {
  const SurfelEchoes& direct;  ///< direct echoes of all visible parts
  const std::vector<Visibility>&
      others;               ///< one entry per surfel: those without an echo are hidden, turned away, or seen (by no
                            ///< ray); others do not count
  const Contributors& all;  ///< contributors of this ping, with their total energy
};

/// Returns the labels of the pixels of a ping (E125).
///
/// The cell of a pixel is as wide as the half-power widths of pulse and beam (in direction cosine; for planar arrays
/// also across rows). It is at least as wide as a bin and the distance to the next beams. A pixel gets the visible
/// material with the most energy in its cell. The label of a part, if it has one, replaces the materials of its
/// surfels. The share is the energy of that material within a whole width to either side, i.e. the main lobe, over the
/// energy of all contributors.
///
/// A cell with only hidden or back-facing surface is shadow. A cell without surface takes the material of a visible
/// surfel whose radius and main lobe cover it, so that gaps between surfels get no label of their own; otherwise it is
/// nothing. The radius of a part, or of a surfel without parts, is that of its area. Energies are those of E63, without
/// phases.
///
/// Throws Error(argument) for contributors of another extent or without total, for `others` of another length than the
/// scene, and as find_contributors does.
PixelLabels label_pixels(const SceneCloud& scene, const SeenSurface& seen, const SonarHead& head,
                         const Pose& world_from_head, const Medium& medium, int threads = 0);

}  // namespace insonify
