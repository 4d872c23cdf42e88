// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "sampling/insonified_region.hpp"
#include "scene/detail_levels.hpp"
#include "scene/prepared_scene.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// A scene as fine as a head resolves it, for one ping.
struct SceneCut {
  PreparedScene scene;  ///< with SceneCloud::part_of of the whole
  /// Index of a surfel of the whole for each surfel of the cut: itself, or of those that are merged the one nearest to
  /// their middle.
  std::vector<std::uint32_t> stands_for;
};

/// How coarse a cut may be.
struct CutOptions {
  double most_width = 0;        ///< largest width of a node, in beam widths
  double most_spacing = 0;      ///< width that a node may have at any range [m]
  double range_resolution = 0;  ///< range resolution of the head [m]
  int threads = 0;              ///< 0: all cores; the cut does not depend on it
};

/// Returns what a ping needs of a scene (E137): within `region` a node of the scene's levels of detail stands for its
/// surfels, if
///
///   width <= r fan.beam_width most_width     at its nearest range r: no beam resolves its surfels,
///            or most_spacing                 which is the same for all pings
///   thickness <= range_resolution / 4        nor does the pulse
///   spread of normals <= 0.003 q             it is flat, or the head looks down on it so steeply that
///            or 0.008 q cos^2(incidence)     its relief hides nothing (not with most_spacing alone)
///
/// with width = sqrt(area) and q = (largest width allowed) / width, at most 8, since errors of many narrow nodes
/// average out. All of a node lies within the region and on one side of either end of `gate` (the sampled ranges). Its
/// area is such that Lambert's law gives the mean over the normals of its surfels. Surfels elsewhere in the region
/// stand for themselves, and so do those of nodes at silhouettes (E172), where one direction sees the node and the
/// next, a twentieth of the largest width away, something behind or before it: in scenes with noise, which were
/// scanned, and in all of fewer than 2^19 surfels. The surface of a node lies sqrt(area of a surfel) + 16 thickness
/// below its plane at most, as far as its disc hides others.
///
/// In tenths of the ranges in which relief hides itself nodes at grazing incidence are at most 0.04 of the largest width
/// wide (E225; not with most_spacing).
///
/// The surfels within the region alone give the same cut. Errors as detail_levels.
SceneCut cut_scene(const PreparedScene& prepared, const InsonifiedRegion& region, const BeamFan& fan,
                   const RangeGate& gate, const CutOptions& options);

/// Surfels and levels of a piece of a scene that are loaded as a cut needs them. Cells of a piece hold all their
/// surfels. `nearest` of a node is the id of the surfel. A node without children is a surfel: its point, normal, area,
/// material, and its position and area again.
struct LoadedLevels {
  SceneCloud scene;     ///< its surfels, those that were loaded
  DetailLevels levels;  ///< all roots; nodes and their children as far as they were loaded, without blocks
  virtual ~LoadedLevels() = default;
  /// Loads levels.node[node] and its children. Nodes that were loaded keep their addresses.
  virtual void need_node(std::size_t node) = 0;
  /// Loads a surfel.
  virtual void need_surfel(std::size_t surfel) = 0;
};

/// A scene in pieces, of which a ping needs some. Several threads may call.
class LevelSource {
 public:
  virtual ~LevelSource() = default;
  /// Returns a cloud without surfels that has all else of the scene, with part_of set.
  virtual const SceneCloud& like() const = 0;
  /// Returns whether surfels and nodes have noise.
  virtual bool noisy() const = 0;
  /// Returns the number of the pieces that may intersect the region of the cut.
  virtual std::size_t pieces() const = 0;
  /// Opens a piece.
  virtual std::unique_ptr<LoadedLevels> open(std::size_t piece) const = 0;
  /// Receives the number of surfels and nodes that a piece gave to the cut; may throw to end it.
  virtual void note(std::size_t taken) const = 0;
};

/// Returns what cut_scene returns of the whole scene, by ascending id; some surfels outside of the region may differ.
/// Throws what the source throws.
SceneCloud cut_levels(const LevelSource& source, const InsonifiedRegion& region, const BeamFan& fan,
                      const RangeGate& gate, const CutOptions& options);

}  // namespace insonify
