// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "scene/ground.hpp"
#include "scene/placed_part.hpp"
#include "survey/part_placement.hpp"

namespace insonify {

/// Surfels that a scene places, as they lie in their file.
struct SceneBody {
  std::string name, label;
  std::shared_ptr<const SceneCloud> cloud;
  /// Of the axes of the cloud in those of the file, both of which are alike in direction [m].
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
};

/// A part of a scene: a body, and where it stands.
struct PartDefinition {
  SceneBody body;
  PartPlacement placement;
};

/// Bodies strewn over an area.
struct SceneScatter {
  std::vector<SceneBody> bodies;  ///< each as likely as the others
  ScatterRule rule;
};

/// The parts of a scene at any time: those that rest, which are placed once, and those that move or are drawn anew.
/// Several threads may ask at once.
class SceneParts {
 public:
  /// Places what rests, part by part: each on the captured parts and on those that rest before it. Bodies of scatters
  /// rest on these too, not on one another; unless `drawn_anew` they rest as they are drawn first. Throws
  /// Error(content) for two parts of one name, a part without area, a hole of the ground where something is to rest, an
  /// area beyond the captured parts, and bodies for which no place is found.
  SceneParts(std::vector<PartDefinition> parts, std::vector<SceneScatter> scatters, std::uint64_t seed,
             bool drawn_anew = false);

  /// Returns what rests, in the order of the parts. A part that is wholly below the ground is not among them.
  const std::vector<PlacedPart>& resting() const { return resting_; }
  /// Returns what moves, at `time` [s], and what is drawn, a function of seed and `draw` alone; bodies that a
  /// draw does not have are absent (PlacedPart), so that the parts of all draws have the same names. Throws
  /// Error(content) for a time outside a trajectory, naming the part, and where bodies do not fit.
  std::vector<PlacedPart> others_at(double time, std::uint64_t draw) const;
  /// Returns true if nothing moves or is drawn anew.
  bool still() const { return !moves() && !drawn_anew(); }
  /// Returns true if a part moves.
  bool moves() const { return !moving_.empty(); }
  /// Returns true if bodies are drawn anew.
  bool drawn_anew() const { return drawn_anew_; }
  /// Returns time 0, or if a trajectory begins later the time at which all have begun [s].
  double begin() const;
  /// Throws Error(content) naming the part unless all trajectories cover the times from `first` to `last` [s].
  void require_times(double first, double last) const;

  /// Returns the names that parts may have, in the order of parts and scatters: those of bodies are NAME-1, NAME-2, ...
  const std::vector<std::string>& names() const { return names_; }
  /// Returns the materials of what is not among resting().
  std::vector<Material> others_materials() const;

 private:
  /// A body that is drawn, with the number from which its copies count.
  struct Drawable {
    SceneBody body;
    int numbers_from = 0;
    double radius = 0;  ///< of the ball about the origin of its axes that holds it [m]
  };
  struct Strewn {
    std::vector<Drawable> bodies;
    ScatterRule rule;
  };
  void place(const PartDefinition& part);
  void prepare_scatter(const SceneScatter& scatter);
  /// Lists the bodies of a scatter that are not among the parts of a draw.
  static void add_absent(const Strewn& strewn, std::vector<PlacedPart>& parts);
  std::vector<PlacedPart> drawn(std::uint64_t draw) const;
  std::vector<PlacedPart> drawn_of(std::size_t scatter, std::uint64_t draw) const;

  std::uint64_t seed_;
  bool drawn_anew_;
  std::vector<PlacedPart> resting_;
  std::vector<std::pair<PartDefinition, PlacedPart>> moving_;  ///< with the part at time 0
  std::vector<Strewn> strewn_;
  std::vector<std::string> names_;
  Ground ground_;
  mutable std::mutex guard_;
  mutable std::vector<std::pair<std::uint64_t, std::shared_ptr<const std::vector<PlacedPart>>>> kept_draws_;
};

}  // namespace insonify
