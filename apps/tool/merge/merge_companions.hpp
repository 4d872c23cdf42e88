// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "store/merge_cubes_by_time.hpp"
#include "store/run_directory.hpp"

namespace insonify::tool {

/// Joins what the merged runs hold beside their cubes: returns (.ply and .pcd, with the numbers of the merged pings),
/// contributors (contributors/000000.h5 and so on, in the order of the pings) and insonification (.ply and .pcd). What
/// not all of the runs have is left out; the notes that are returned say so. `manifest` gets what was joined. Throws as
/// the readers and writers of these files.
std::vector<std::string> merge_companions(const RunDirectory& directory, const std::vector<std::string>& runs,
                                          const MergedCube& merged, nlohmann::ordered_json& manifest);

}  // namespace insonify::tool
