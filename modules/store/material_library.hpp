// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "scene/material.hpp"
#include "store/sourced_number.hpp"

namespace insonify {

/// A material of data/materials as its file describes it.
struct MaterialFile {
  Material material;
  std::string description, path;
  std::vector<SourcedNumber> numbers;
};

/// Returns the path of a table of materials. "" selects insonify's table for Lambert's law, "natural" the table for the
/// built-in scenes with laws of their own; any other name is a path and is returned unchanged.
std::string path_of_materials(const std::string& name);

/// Returns a material from TOML; every key is a value or a table {value, status, source}. Throws Error(file) or
/// Error(content).
MaterialFile load_material_file(const std::string& path);

/// Returns all materials with laws of their own, sorted by name. Each is called NAME@LAW; a sediment appears once for
/// each of its laws.
std::vector<MaterialFile> list_materials();

/// Returns the names of all materials: those of Lambert's table, and those with laws of their own.
std::vector<std::string> material_names();

/// Returns a material by name: a name of Lambert's table, NAME@LAW, or NAME alone if Lambert's table does not have it
/// ("medium-sand"). Throws Error(argument) with the nearest name.
Material find_material(const std::string& name);

/// Returns the same material with description and sources. Throws Error(argument) for a material of Lambert's table.
MaterialFile find_material_file(const std::string& name);

}  // namespace insonify
