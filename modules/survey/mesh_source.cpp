// SPDX-License-Identifier: BSD-3-Clause
#include "survey/mesh_source.hpp"

#include <cmath>

#include "core/text.hpp"
#include "sampling/mesh_surfels.hpp"
#include "simulate/resolve_ping.hpp"

namespace insonify {

MeshSample mesh_sample_for(const SceneMesh& mesh, std::size_t overview, double memory_gib,
                           const PingSimulator& simulator, const PingEvent& event) {
  const ResolvedPing ping =
      resolve_ping(mesh.whole, simulator.head(), event, simulator.environment(), simulator.options());
  constexpr double bytes = bytes_to_ping + bytes_of_facet;
  const std::size_t most =
      memory_gib > 0 ? static_cast<std::size_t>(std::ceil(memory_gib * 0x1p30 / bytes)) : default_mesh_surfels;
  MeshSurfels fine = mesh_surfels(mesh, ping.region, ping.head.fan, ping.view.sampling, most);
  MeshSample sample;
  if (fine.coarsening > 1)
    sample.note = printed("the mesh is sampled by at most %zu surfels (%.2g GiB), ", most,
                          static_cast<double>(most) * bytes / 0x1p30) +
                  (std::isinf(fine.coarsening)
                       ? printed("fewer than its triangles within reach: an overview of %zu surfels is taken", overview)
                       : printed("which are %.0f times as large as the beams need", fine.coarsening)) +
                  "; raise --memory-limit, or narrow the range";
  if (!std::isinf(fine.coarsening)) sample.scene = std::move(fine.scene);
  return sample;
}

}  // namespace insonify
