// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "returns/coverage.hpp"

namespace insonify {

/// Writes surfels by ascending id as a binary .ply: x y z and scalar_intensity (double), scalar_level_db (of it, dB re
/// 1 uPa), scalar_grazing_deg, scalar_range (float), scalar_pings and scalar_id (uint). Written to a temporary name,
/// then renamed. Throws Error(argument) unless ids ascend, Error(file) if it cannot write.
void save_coverage(const std::string& path, const std::vector<CoveredSurfel>& covered);

/// Makes one file of several: what they say of one surfel is added up, in the order of the parts; its place is that of
/// the first that has it. Holds about 64 MB of them at a time, whatever their number and length. Throws Error(argument)
/// without parts, Error(file) for one that is missing or if it cannot write, Error(content) for one that save_coverage
/// did not write.
void join_coverage(const std::string& path, const std::vector<std::string>& parts);

}  // namespace insonify
