// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "formats/swath_record.hpp"
#include "tool/compare/compared_files.hpp"

namespace insonify::tool {

/// Compares two swaths: level, deviation and coverage by angle (E212), and mean heights in cells with their predicted
/// deviations (E213). One may be a run, which counts with its soundings as its GSF states them. Rejected soundings do
/// not count. Throws Error(argument) if one is neither swath nor run, and as export_product.
nlohmann::ordered_json compare_swaths(const CompareOptions& options);

/// Returns the result in words.
std::string swaths_table(const nlohmann::ordered_json& result);

}  // namespace insonify::tool
