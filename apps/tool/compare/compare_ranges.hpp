// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "tool/compare/compared_files.hpp"

namespace insonify::tool {

/// Levels, speckle and response of both images in five bands of the range that they share; null without a range.
nlohmann::ordered_json range_bands_json(const ComparedFile& a, const ComparedFile& b);

/// First returns, altitude and shadows of both waterfalls; null of other images.
nlohmann::ordered_json side_scan_json(const ComparedFile& a, const ComparedFile& b);

/// Both in words; empty if they are null.
std::string ranges_table(const nlohmann::ordered_json& bands, const nlohmann::ordered_json& side_scan);

}  // namespace insonify::tool
