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

/// A body that a scene places: surfels in the coordinates of their file.
struct SceneBody {
  std::string name, label;
  std::shared_ptr<const SceneCloud> cloud;
  /// Origin of the cloud's axes in those of the file [m]; both axes have the same directions.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< along these axes [m]; zero: the box of its surfels
};

/// A part of a scene: a body and its placement.
struct PartDefinition {
  SceneBody body;
  PartPlacement placement;
};

/// Bodies at random positions in an area, and the rule for them.
struct SceneScatter {
  std::vector<SceneBody> bodies;  ///< each as likely as the others
  ScatterRule rule;
};

/// The parts of a scene at any time. Resting parts are placed once; other parts move or are drawn anew. Several threads
/// may call the const functions at once.
class SceneParts {
 public:
  /// Places the resting parts one by one, each on the captured parts and on the resting parts before it. Scattered
  /// bodies also rest on these, not on one another; unless `drawn_anew`, they rest as in the first draw. Throws
  /// Error(content) for two parts of one name, a part without area, a hole of the ground under a resting part, an area
  /// beyond the captured parts, and bodies for which no position is found.
  SceneParts(std::vector<PartDefinition> parts, std::vector<SceneScatter> scatters, std::uint64_t seed,
             bool drawn_anew = false);

  /// Returns the resting parts in their order, without parts that are wholly below the ground.
  const std::vector<PlacedPart>& resting() const { return resting_; }
  /// Returns the moving parts at `time` [s] and the drawn bodies, which depend on seed and `draw` alone. A body that a
  /// draw does not have is an absent part (PlacedPart), so that the parts of all draws have the same names. Throws
  /// Error(content) for a time outside a trajectory, naming the part, and if bodies do not fit.
  std::vector<PlacedPart> others_at(double time, std::uint64_t draw) const;
  /// Returns true if no part moves and no body is drawn anew.
  bool still() const { return !moves() && !drawn_anew(); }
  /// Returns true if a part moves.
  bool moves() const { return !moving_.empty(); }
  /// Returns true if bodies are drawn anew.
  bool drawn_anew() const { return drawn_anew_; }
  /// Returns the earliest time >= 0 at which all trajectories have begun [s].
  double begin() const;
  /// Throws Error(content) naming the part unless all trajectories cover the times from `first` to `last` [s].
  void require_times(double first, double last) const;

  /// Returns all names that parts may have, in the order of parts and scatters. Scattered bodies are NAME-1, NAME-2,
  /// ...
  const std::vector<std::string>& names() const { return names_; }
  /// Returns the table of materials of all parts, present or absent, in the order of parts and scatters. An index in it
  /// is the number of a class at all times and in all draws. A body with a label has a material of that name; a body
  /// without one has the materials of its cloud. Materials that are no classes come last. If no cloud has a material of
  /// the name of a label, the table has one that no surfel has.
  const std::vector<Material>& materials() const { return materials_; }

 private:
  /// A body to draw, and the number from which its copies count.
  struct Drawable {
    SceneBody body;
    int numbers_from = 0;
    double radius = 0;  ///< radius of the ball about the origin of its axes [m]
  };
  struct ScatteredBodies {
    std::vector<Drawable> bodies;
    ScatterRule rule;
  };
  /// Fills materials_.
  void number_classes(const std::vector<PartDefinition>& parts, const std::vector<SceneScatter>& scatters);
  void put(const PartDefinition& part);
  void prepare_scatter(const SceneScatter& scatter);
  /// Adds the bodies of a scatter that a draw does not have as absent parts.
  static void add_absent(const ScatteredBodies& scattered, std::vector<PlacedPart>& parts);
  std::vector<PlacedPart> drawn(std::uint64_t draw) const;
  std::vector<PlacedPart> drawn_of(std::size_t scatter, std::uint64_t draw) const;

  std::uint64_t seed_;
  bool drawn_anew_;
  std::vector<PlacedPart> resting_;
  std::vector<std::pair<PartDefinition, PlacedPart>> moving_;  ///< with the part at time 0
  std::vector<ScatteredBodies> scattered_;
  std::vector<std::string> names_;
  std::vector<Material> materials_;
  Ground ground_;
  mutable std::mutex guard_;
  mutable std::vector<std::pair<std::uint64_t, std::shared_ptr<const std::vector<PlacedPart>>>> kept_draws_;
};

}  // namespace insonify
