// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "tool/compare/compared_files.hpp"

namespace insonify::tool {

/// How far soundings lie from the scene that they are of: of their mean heights in cells that hold both, and of single
/// soundings from the nearest point of the scene.
nlohmann::ordered_json compare_soundings(const CompareOptions& options);

/// The result in words.
std::string soundings_table(const nlohmann::ordered_json& result);

}  // namespace insonify::tool
