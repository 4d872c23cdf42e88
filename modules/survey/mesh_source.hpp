// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "scene/scene_mesh.hpp"
#include "simulate/ping_simulator.hpp"

namespace insonify {

constexpr double bytes_to_ping = 192;  ///< per surfel read: surfel, index, scatterers and echoes
constexpr double bytes_of_facet = 88;  ///< besides, per surfel of a mesh: its triangle, in the scene and in head axes

/// Surfels of a mesh that a ping needs (E70), within a limit of memory.
struct MeshSample {
  std::optional<SceneCloud> scene;  ///< empty: the overview of the mesh
  std::string note;                 ///< what could not be kept; empty: all is
};

/// Returns the surfels of a mesh for one ping. `overview`: surfels of the overview that is pinged if not even its
/// triangles within reach fit; memory_gib: limit [GiB], 0: that of default_mesh_surfels. Throws as mesh_surfels.
MeshSample mesh_sample_for(const SceneMesh& mesh, std::size_t overview, double memory_gib,
                           const PingSimulator& simulator, const PingEvent& event);

}  // namespace insonify
