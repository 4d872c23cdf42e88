// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "run/options.hpp"
#include "scene/material_shares.hpp"
#include "scene/scene_cloud.hpp"
#include "store/material_library.hpp"
#include "store/materials_file.hpp"

/// Facts of a file or folder for `info`, by name, and under `next` the commands that go on from there.
namespace insonify::tool {

/// Returns facts of a cube of pings, or of a run if the path of its folder is given.
nlohmann::ordered_json info_of_cube(const std::string& path);

/// Returns facts of a folder: a run, a survey, a head of one, or anything else with a manifest of insonify. Throws
/// Error(content) for another folder.
nlohmann::ordered_json info_of_folder(const std::string& path);

/// Returns facts of a TOML file by its keys: a scene of parts, a mission, a table of materials, settings of a run, an
/// environment or a sonar. Throws as the reader of each.
nlohmann::ordered_json info_of_toml(const std::string& path);

/// Returns facts of a cloud, mesh, raster or tiles. `requested` overrules the meaning of the file; tiles are prepared and
/// ignore it.
nlohmann::ordered_json info_of_scene(const std::string& path, MeaningText requested);

/// Commands that go on from a scene with this box: a ping from before and above it that looks at its middle, and a
/// mission of two lines or more over it.
std::vector<std::string> next_of_scene(const std::string& path, const Bounds& box);

/// Returns facts of a recording of a real sonar, by its first ping.
nlohmann::ordered_json info_of_record(const std::string& path);

/// Returns facts of a recorded swath: soundings, their extent, levels and deviations, the way, and kinds of records.
nlohmann::ordered_json info_of_swath(const std::string& path);

/// Prints what info_of_scene says of a cloud, mesh or raster.
void print_scene(const nlohmann::ordered_json& info);

/// A path as a shell takes it.
std::string shell_word(const std::string& path);

// Materials as the tool lists them: names, numbers and sources of a table, shares of a scene.

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
