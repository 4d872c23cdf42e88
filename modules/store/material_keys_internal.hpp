// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "store/key_table.hpp"
#include "store/materials_file.hpp"

namespace insonify {

/// A [[material]] of a file.
struct MaterialEntry {
  SourcedMaterial sourced;
  MaterialInterval interval{};  ///< interval of field values, if the file has one
  std::string law, like;        ///< law: "" is Lambert's law, or that of the material `like`
  std::array<std::optional<double>, std::size(law_numbers)> numbers{};  ///< numbers given, in order of law_numbers
  TableLaw table{};
  std::string bistatic;
};

/// Returns the keys of a [[material]], bound to `entry`, including those of material_numbers and law_numbers.
std::vector<Key> material_keys(MaterialEntry& entry);

/// Reads a table of keys into `entry`, which starts as a copy of find_like(like) if the table names a material `like`.
/// Throws Error(content) with path and line for keys that are unknown, missing, out of range or of another law.
void read_material(const std::string& path, const TomlValue& table, MaterialEntry& entry,
                   const std::function<Material(const std::string&)>& find_like,
                   const std::vector<std::string>& others = {});

}  // namespace insonify
