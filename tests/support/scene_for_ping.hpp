// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "sampling/mesh_surfels.hpp"
#include "scene_io/load_scene.hpp"
#include "simulate/resolve_ping.hpp"

namespace insonify {

/// Returns the surfels of a loaded scene, or of its mesh, for a ping in default water.
inline SceneCloud scene_for_ping(const LoadedScene& loaded, const SonarHead& head, const Pose& pose,
                                 const SimulationOptions& options) {
  if (!loaded.mesh) return loaded.scene;
  const ResolvedPing ping = resolve_ping(loaded.mesh->whole, head, {pose}, {}, options);
  return mesh_surfels(*loaded.mesh, ping.region, ping.head.fan, ping.view.sampling).scene;
}

}  // namespace insonify
