// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "sampling/find_scatterers.hpp"
#include "sampling/insonified_region.hpp"
#include "scene/scene_mesh.hpp"

namespace insonify {

/// Default of the most surfels that a ping samples from a mesh; with scatterers and echoes about 2.2 GiB.
inline constexpr std::size_t default_mesh_surfels = std::size_t{1} << 23;

/// Surfels of a mesh that a ping needs.
struct MeshSurfels {
  SceneCloud scene;  ///< with SceneCloud::part_of = SceneMesh::whole, and the parts as facets
  double coarsening =
      1;  ///< factor by which areas exceed what the head resolves, so that most_surfels holds; infinite if
          ///< there are more triangles than most_surfels, and then no surfels
};

/// Samples the triangles within `region` as finely as the head resolves them (E70): parts of a triangle, made by
/// bisecting longest edges, have one surfel each, with the part's area, at random within it. A part is small enough if
/// its area is at most that of a resolution cell (E17), of a square half as wide as a main lobe, and a sixteenth of a
/// main lobe, all at its range; and the square of its longest edge at most eight times that.
///
/// The areas of a triangle's parts add up to its area. A part has the same position and id in every ping, so speckle is
/// bound to the mesh; of a part that is bisected, one half keeps place and id. Region and threads do not change that.
/// The 2^32 ids are distributed by area, which limits parts to 1.2 cm on 400 m x 400 m; find_scatterers splits further.
///
/// region        ResolvedPing::region
/// options       range_resolution, seed and threads; range_resolution 0: two bins of the region's gate
///
/// Throws Error for an invalid mesh, fan or gate, or most_surfels = 0.
MeshSurfels mesh_surfels(const SceneMesh& mesh, const InsonifiedRegion& region, const BeamFan& fan,
                         const SamplingOptions& options = {}, std::size_t most_surfels = default_mesh_surfels);

/// Limit of a sample of evenly spaced surfels.
struct EvenLimit {
  std::string where = "even_surfels";                       ///< with which messages begin: a path
  double memory = std::numeric_limits<double>::infinity();  ///< [bytes]
};
/// Returns about how many surfels `spacing` [m] apart a surface of `area` [m^2] has, at least 1. Whatever samples
/// surfaces evenly asks here before it begins. Throws Error(content) for more than 4e8, Error(memory) if they need more
/// than limit.memory.
std::size_t count_even_surfels(double area, double spacing, const EvenLimit& limit);

/// Surfels of a whole mesh for any ping, and the corner of the mesh that is nearest to each.
struct EvenSurfels {
  SceneCloud scene;  ///< with parts of triangles as facets
  std::vector<std::uint32_t> corner;
};

/// Samples all triangles evenly: parts as in mesh_surfels, with a mean area of `spacing`^2 [m^2] and at most 1.4 times
/// that; a smaller triangle has one surfel. The result does not depend on `threads` (0: all cores). Throws Error for an
/// invalid mesh or spacing, and as count_even_surfels.
EvenSurfels even_surfels(const SceneMesh& mesh, double spacing, std::uint64_t seed = 1, int threads = 0,
                         const EvenLimit& limit = {});

}  // namespace insonify
