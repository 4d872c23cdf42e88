// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "scene/placed_part.hpp"
#include "scene/prepared_scene.hpp"

namespace insonify {

/// Returns one cloud of all parts. The parts are sorted by name, so the order in which they are given does not matter.
/// Materials that agree in all numbers and name become one. The table of materials begins with `materials`, used or
/// not. Surfels hide as discs. Throws Error(argument) for an invalid part, two parts of one name, more than 65 000
/// parts, and materials that do not fit into the table.
SceneCloud merge_parts(std::span<const PlacedPart> parts, std::span<const Material> materials = {});

/// A scene in which some parts get a new pose for every ping. The resting parts are prepared once; a part that moves or
/// is new costs time in proportion to its own surfels. Not for use by several threads at once.
class PosedScene {
 public:
  /// Prepares the parts that rest. The table of materials begins with `materials`, used or not; if these hold all
  /// materials of all parts, the table is the same for all poses. Throws as merge_parts.
  explicit PosedScene(std::span<const PlacedPart> resting, std::span<const Material> materials = {}, int threads = 0);
  ~PosedScene();
  PosedScene(PosedScene&&) noexcept;
  PosedScene& operator=(PosedScene&&) noexcept;

  /// Returns the scene with `others` as its other parts; they replace those of the previous call. The returned scene is
  /// valid until the next call. Throws as merge_parts.
  std::shared_ptr<const PreparedScene> pose(std::span<const PlacedPart> others);

 private:
  friend class EditedScene;
  struct State;
  struct Made {};  // chooses a constructor
  PosedScene(Made, std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// The contents of an edited scene at one time: its parts but the captured ones, in the order of their ids, of which those
/// that were removed are absent, and the materials of all parts that it ever had but those of the captured ones.
struct SceneArrangement {
  std::vector<PlacedPart> parts;
  std::vector<Material> materials;
};

/// A scene whose parts are added, moved and removed between pings. The first edit apart, an edit costs time in
/// proportion to the surfels of its part. A part keeps its id, the number of its pixels in instance images, and a class
/// its number, whatever else is edited. One thread edits; any thread may ask for the scene of an arrangement.
class EditedScene {
 public:
  /// Begins with these parts; their ids are their positions by name, from 1. The table of materials begins with
  /// `materials`. Throws as merge_parts.
  explicit EditedScene(std::vector<PlacedPart> parts, std::span<const Material> materials = {}, int threads = 0);

  /// Adds a part and returns its id: the next, or that of the removed part of this name. Throws Error(argument) for an
  /// invalid, absent or captured part, and for one whose name another part has.
  std::uint32_t add(PlacedPart part);
  /// Places the axes of a part's file at a pose, with a velocity of their origin [m/s] and a turn rate [rad/s], world
  /// axes. Throws Error(argument) for an id that no part has, for a captured part, and for an invalid pose.
  void move(std::uint32_t id, const Pose& world_from_file, const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero(),
            const Eigen::Vector3d& turn_rate = Eigen::Vector3d::Zero());
  /// Takes a part out. Throws Error(argument) for an id that no part has, and for a captured part.
  void remove(std::uint32_t id);

  /// Returns what the scene holds now. Later edits do not change it.
  std::shared_ptr<const SceneArrangement> now() const { return now_; }
  /// Returns the scene of an arrangement of this object, which lives as long as the pointer. As long as pointers to
  /// scenes of other arrangements are in use, it costs the time of a whole scene.
  std::shared_ptr<const PreparedScene> scene_of(std::shared_ptr<const SceneArrangement> arrangement) const;

 private:
  struct Start;
  PlacedPart& part_of(std::uint32_t id, SceneArrangement& in, const char* who) const;
  std::shared_ptr<Start> start_;
  std::shared_ptr<const SceneArrangement> now_;
};

}  // namespace insonify
