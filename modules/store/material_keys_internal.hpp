// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "store/key_table_internal.hpp"
#include "store/materials_file.hpp"

namespace insonify {

/// A [[material]] of a file.
struct MaterialEntry {
  SourcedMaterial sourced;
  MaterialInterval interval{};  ///< of field values, if the file has one
  std::string law, like;        ///< "": Lambert's, or that of the material that it is like
  std::array<std::optional<double>, std::size(law_numbers)> numbers{};  ///< those given, as law_numbers
  TableLaw table{};
  std::string bistatic;
};

/// The keys of a [[material]], bound to it: those of material_numbers and law_numbers among them.
std::vector<Key> material_keys(MaterialEntry& entry);

/// Reads a table of keys into `entry`, which begins as the material that it is like. Throws Error(content) with path and
/// line for what is unknown, missing, out of range or of another law.
void read_material(const std::string& path, const TomlValue& table, MaterialEntry& entry,
                   const std::vector<std::string>& others = {});

}  // namespace insonify
