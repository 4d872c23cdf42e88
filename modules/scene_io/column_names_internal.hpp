// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <string>
#include <vector>

#include "scene_io/raw_cloud_internal.hpp"

// Private to scene_io: the meaning of columns by their names.
namespace insonify {

/// Returns a column's name in lower case without the prefix "scalar_" of CloudCompare, with "_" for blanks as
/// CloudCompare writes them, and without a unit in brackets.
std::string plain_name(const std::string& name);

/// The columns of a table that a scene uses; null: absent.
struct Columns {
  std::array<const RowTable::Column*, 3> position{}, normal{};
  const RowTable::Column *area = nullptr, *label = nullptr, *id = nullptr, *noise = nullptr;
};

/// Finds columns by their names. The column of labels is `material_field`, unless that is empty. Throws Error(content)
/// if a coordinate or the material field is missing; the message lists the names looked for.
Columns find_columns(const RowTable& table, const std::string& path, const std::string& material_field);

/// Returns true if the names of columns include all three coordinates.
bool name_coordinates(const std::vector<std::string>& names);

/// Sets the facts that the names of the coordinates state: units, degrees, depths. `table` has one row at least.
void take_headings(const RowTable& table, const Columns& found, RawCloud& raw);

/// Returns true if every reader of PLY, PCD, VTK and HDF5 takes a name: it begins with a letter or "_", goes on with
/// letters, digits, "_", "-" or ".", has at most 64 characters, and has no other meaning for such readers.
bool is_legal_name(const std::string& name);

/// Returns legal and unique names in the same order. Legal names stay; all others become lower-case, with "_" for other
/// characters. A name that occurs in `taken` or earlier, without regard to case and "scalar_", gets "_in_file", and a
/// number from 2 on if that occurs too.
std::vector<std::string> legal_names(const std::vector<std::string>& names, const std::vector<std::string>& taken);

}  // namespace insonify
