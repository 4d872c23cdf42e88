// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "scene/scene_mesh.hpp"
#include "simulate/ping_simulator.hpp"

namespace insonify {

constexpr double bytes_to_ping = 192;  ///< [bytes] per surfel that is read: surfel, index, scatterers and echoes
constexpr double bytes_of_facet = 88;  ///< [bytes], besides, per surfel of a mesh: its triangle, in scene and head axes

/// The surfels of a mesh that one ping needs (E70), within a limit of memory.
struct MeshSample {
  std::optional<SceneCloud> scene;  ///< empty: use the overview of the mesh
  std::string note;                 ///< what could not be kept; empty: all was kept
};

/// Returns the surfels of a mesh for one ping. `overview` is the number of surfels of the overview, which is pinged if
/// not even the triangles within reach fit into memory. `memory_gib` is the limit [GiB]; 0: that of
/// default_mesh_surfels. Throws as mesh_surfels.
MeshSample mesh_sample_for(const SceneMesh& mesh, std::size_t overview, double memory_gib,
                           const PingSimulator& simulator, const PingEvent& event);

}  // namespace insonify
