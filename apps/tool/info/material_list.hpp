// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "scene/material_shares.hpp"
#include "store/material_library.hpp"
#include "store/materials_file.hpp"

/// Materials as the tool lists them: names, numbers and sources of a table, shares of a scene.
namespace insonify::tool {

/// Sound speed [m/s] of the strengths that are listed and drawn.
inline constexpr double material_sound_speed = 1500;

/// Path of the table that is part of insonify.
std::string built_in_materials();

/// A list of name, label, the numbers under the keys of material files, status and source.
nlohmann::ordered_json materials_json(const std::vector<SourcedMaterial>& materials);

/// Prints a table of them, and the law that the numbers belong to.
void print_materials(const std::vector<SourcedMaterial>& materials);

/// A material with a law of its own: name, description, law, numbers with status and source.
nlohmann::ordered_json material_json(const MaterialFile& file);

/// Prints such materials: as a table, or each with its numbers and what is known of its law.
void print_material_files(const std::vector<MaterialFile>& files, bool as_table);

/// For each material of a scene: name, law, points, share and, where areas are known, area_m2.
nlohmann::ordered_json shares_json(const std::vector<MaterialShare>& shares);

}  // namespace insonify::tool
