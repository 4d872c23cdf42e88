// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace insonify {

/// Joins files insonification.ply of pings of one scene: hits are added up; of level_db, scattering_db, cell_level_db
/// and grazing_deg the highest is kept, of range the least. Writes `ply` and `pcd` as save_insonification does, each to
/// a temporary name, then renamed. Returns false, and writes nothing, if the parts are of different scenes. Throws
/// Error(argument) without parts, Error(file) for one that is missing or if it cannot write, Error(content) for one
/// that save_insonification did not write.
bool join_insonification(const std::string& ply, const std::string& pcd, const std::vector<std::string>& parts);

}  // namespace insonify
