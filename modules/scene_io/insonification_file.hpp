// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace insonify {

/// Joins files insonification.ply of pings of one scene. Hits are added up. The highest values of level_db,
/// scattering_db, cell_level_db and grazing_deg are kept, and the least of range. Writes `ply` and `pcd` as
/// save_insonification does, each to a temporary name, then renamed. Returns false and writes nothing if the parts are
/// of different scenes. Throws Error(argument) without parts, Error(file) if a part is missing or a file cannot be
/// written, Error(content) for a part that save_insonification did not write.
bool join_insonification(const std::string& ply, const std::string& pcd, const std::vector<std::string>& parts);

}  // namespace insonify
