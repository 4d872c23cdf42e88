// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "sampling/insonified_region.hpp"
#include "scene/prepared_scene.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// A scene as fine as a head resolves it, for one ping.
struct SceneCut {
  PreparedScene scene;  ///< with SceneCloud::part_of of the whole
  /// Of each of its surfels, the index of a surfel of the whole: itself, or of those that are merged the one nearest to
  /// their middle.
  std::vector<std::uint32_t> stands_for;
};

/// How coarse a cut may be.
struct CutOptions {
  double most_width = 0;        ///< of a node, in beam widths
  double most_spacing = 0;      ///< of a node, at any range [m]
  double range_resolution = 0;  ///< of the head [m]
  int threads = 0;              ///< 0: all cores; the cut does not depend on it
};

/// Returns what a ping needs of a scene (E137): within `region` a node of the scene's levels of detail stands for its
/// surfels, if
///
///   sqrt(area) <= r fan.beam_width most_width          at its nearest range r: no beam resolves its surfels,
///                 or most_spacing                      which is the same for all pings
///   thickness <= range_resolution / 4                  nor does the pulse
///   spread of normals <= 0.003, 0.1 cos^2(incidence)   it is flat, and all its surfels face the head
///
/// and all of it lies within the region and on one side of either end of `gate` (the sampled ranges). Its area is such
/// that Lambert's law gives the mean over the normals of its surfels. Surfels elsewhere in the region stand for
/// themselves. The surface of a node lies sqrt(area of a surfel) + 16 thickness below its plane
/// at most, as far as its disc hides others.
///
/// The surfels within the region alone give the same cut. Errors as detail_levels.
SceneCut cut_scene(const PreparedScene& prepared, const InsonifiedRegion& region, const BeamFan& fan,
                   const RangeGate& gate, const CutOptions& options);

}  // namespace insonify
