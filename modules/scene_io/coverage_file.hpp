// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "returns/coverage.hpp"

namespace insonify {

/// Writes surfels by ascending id as a binary .ply with the fields x y z, scalar_intensity (double), scalar_level_db
/// (its level [dB re 1 uPa]), scalar_grazing_deg, scalar_range (float), scalar_pings and scalar_id (uint). The file is
/// written to a temporary name, then renamed. Throws Error(argument) unless ids ascend, Error(file) if it cannot write.
void save_coverage(const std::string& path, const std::vector<CoveredSurfel>& covered);

/// Joins several files into one. Entries of one surfel are added up in the order of the parts; the position is that of
/// the first part with the surfel. About 64 MB are in memory at a time, for any number and length of parts. Throws
/// Error(argument) without parts, Error(file) if a part is missing or the file cannot be written, Error(content) for a
/// part that save_coverage did not write.
void join_coverage(const std::string& path, const std::vector<std::string>& parts);

}  // namespace insonify
