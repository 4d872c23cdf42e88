#pragma once
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "simulate/simulate_ping.hpp"
#include "store/run_directory.hpp"
#include "tool/options.hpp"
#include "tool/ping_setup.hpp"

namespace insonify::tool {

/// Writes the files of --keep beside the cube: contributors.h5, insonification.ply and .pcd, paths.vtp; `manifest` gets
/// a summary of each.
void write_kept(const RunDirectory& directory, const PingOptions& options, const SceneCloud& scene,
                const PingSetup& setup, const SimulatedPing& ping, nlohmann::ordered_json& manifest);

}  // namespace insonify::tool
