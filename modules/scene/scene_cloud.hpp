// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "scene/material.hpp"
#include "scene/scene_part.hpp"

namespace insonify {

/// Statistics of a whole scene. A cloud cut from a scene near a head keeps them, so that a ping of the cut equals a
/// ping of the whole scene.
struct WholeScene {
  std::size_t surfels = 0;
  double mean_spacing = 0;  ///< root of the mean surfel area [m]
  float largest_area = 0;   ///< area of the largest surfel [m^2]
  bool smooth = false;      ///< true: a material is smooth (is_smooth), its mirrors or targets reflect as one body
  double fastest = 0;       ///< speed of the fastest surfel of a moving part [m/s]
};

/// Corners of a triangle [m], relative to the origin of its scene.
using Facet = std::array<Eigen::Vector3f, 3>;

/// The captured scene: surfels (small oriented patches) as a structure of arrays, one entry per surfel in each array
/// but `noise`, `unevenness`, `facet` and `part`, which may be empty. World frame; coordinates are stored in single
/// precision relative to `origin`, which is subtracted in double.
struct SceneCloud {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m]; world position = origin + point
  std::vector<Eigen::Vector3f> point;                ///< [m], relative to origin
  std::vector<Eigen::Vector3f> normal;               ///< unit vectors
  std::vector<float> area;                           ///< true surface area [m^2]
  std::vector<std::uint16_t> material;               ///< index into `materials`
  std::vector<std::uint32_t> id;                     ///< unique in its part; speckle is bound to it
  std::vector<float> noise;                          ///< standard deviation across the surface [m]; empty: 0 everywhere
  /// Largest depth of a surfel's own surface below its plane [m]; empty: its spacing sqrt(area).
  std::vector<float> unevenness{};
  /// Triangle of a surface for each surfel; the surfel lies anywhere in its triangle and hides what the triangle hides.
  /// Empty: surfels hide as discs.
  std::vector<Facet> facet{};
  std::vector<std::uint16_t> part{};  ///< part of each surfel, index into `parts`; empty: the scene is one part
  std::vector<ScenePart> parts{};     ///< parts of a merged scene (merge_parts); empty: the scene is one part
  std::vector<Material> materials = {Material{}};
  bool normals_oriented = true;         ///< false: the sign of a normal has no meaning and both sides reflect
  std::optional<WholeScene> part_of{};  ///< set if this cloud is part of a larger scene

  /// Returns the number of surfels.
  std::size_t size() const { return point.size(); }
  /// Returns the part of a surfel; null if the scene is one part.
  const ScenePart* part_of_surfel(std::size_t surfel) const { return part.empty() ? nullptr : &parts[part[surfel]]; }
  /// Returns true if the normal of a surfel has a sign.
  bool oriented(std::size_t surfel) const {
    return part.empty() ? normals_oriented : parts[part[surfel]].normals_oriented;
  }
  /// Returns the counter of the random numbers of a surfel: its id, combined with the key of its part if the scene has
  /// parts.
  std::uint64_t random_id(std::size_t surfel) const {
    return part.empty() ? std::uint64_t{id[surfel]} : id[surfel] ^ parts[part[surfel]].key;
  }
  /// Returns the id of piece `k` of a surfel (Scatterers::id): id x 2^32 + k, combined with the key of its part if the
  /// scene has parts.
  std::uint64_t piece_id(std::size_t surfel, std::uint64_t k) const {
    const std::uint64_t piece = std::uint64_t{id[surfel]} << 32 | k;
    return part.empty() ? piece : piece ^ parts[part[surfel]].key;
  }
  /// Returns the number k of a piece from its id, the inverse of piece_id.
  std::uint32_t piece_of(std::size_t surfel, std::uint64_t piece_id) const {
    return static_cast<std::uint32_t>(part.empty() ? piece_id : piece_id ^ parts[part[surfel]].key);
  }
};

/// Returns true if some part of the scene moves.
bool moves(const SceneCloud& scene);

/// Appends one surfel at world_position [m] with an area [m^2]. Its id is the id of the last surfel plus 1, which is
/// unique if ids ascend. In a scene with facets the surfel gets a facet without area, which hides nothing. Throws Error
/// if `material` is not an index into scene.materials, and for a scene of parts.
void add_surfel(SceneCloud& scene, const Eigen::Vector3d& world_position, const Eigen::Vector3d& normal, double area,
                std::uint16_t material = 0);

/// Throws Error unless all arrays have the same length, points are finite, normals have unit length within 1e-3, areas
/// and noise are finite and >= 0, and materials and parts exist and are valid. `who` names the caller in the message.
void require_valid(const SceneCloud& scene, const char* who);

/// Returns the statistics of the scene, or those of the whole scene if `scene` is a part; zeros for an empty scene.
WholeScene whole_of(const SceneCloud& scene);

/// Returns the statistics of the union of two scenes.
WholeScene together(const WholeScene& a, const WholeScene& b);

/// Returns the surfels listed in `keep`, in that order, with their ids.
SceneCloud subset(const SceneCloud& scene, const std::vector<std::uint32_t>& keep);

/// Axis-aligned bounding box of the points in world coordinates [m]; min > max for an empty scene.
struct Bounds {
  Eigen::Vector3d min = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-1e300);
};
/// Returns the bounding box of a scene.
Bounds bounds(const SceneCloud& scene);

}  // namespace insonify
