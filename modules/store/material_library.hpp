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

/// The file of a table of materials: "" for Lambert's of insonify, "natural" for that of the built-in scenes with laws of
/// their own, else the path itself.
std::string path_of_materials(const std::string& name);

/// Reads a material from TOML; every key is a value or a table {value, status, source}. Throws Error(file) or
/// Error(content).
MaterialFile load_material_file(const std::string& path);

/// All materials with laws of their own, sorted by name: each is called NAME@LAW, a sediment once for each of its laws.
std::vector<MaterialFile> list_materials();

/// Names of all materials: those of Lambert's table, and those with laws of their own.
std::vector<std::string> material_names();

/// A material by name: of Lambert's table, or NAME@LAW, or NAME alone where the table has none such ("medium-sand").
/// Throws Error(argument) with the nearest name.
Material find_material(const std::string& name);

/// The same with description and sources. Throws Error(argument) for a material of Lambert's table.
MaterialFile find_material_file(const std::string& name);

}  // namespace insonify
