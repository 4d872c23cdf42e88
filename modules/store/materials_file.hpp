// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "scene/material.hpp"
#include "scene/material_field.hpp"

namespace insonify {

/// A material with the source of its values.
struct SourcedMaterial {
  Material material;
  int label = 0;  ///< label of this material in a cloud
  std::string status, source;
};

/// A file of materials, and the rule that assigns them to the points of a cloud.
struct MaterialTable {
  std::vector<SourcedMaterial> materials;
  MaterialField field;  ///< intervals refer to materials by label, the index in materials_by_label
};

/// Returns a table of materials from TOML. The keys of a [[material]] are name, those of material_numbers, label
/// (default: its position), status and source. The top-level key `field` names the scalar field that holds the labels.
/// Alternatively each material has a half-open interval of field values, `from` (included) to `to` (excluded); one of
/// the two may be omitted. Unknown keys, overlapping intervals and unphysical values are errors with file and line.
MaterialTable load_materials(const std::string& path);

/// Returns the materials with index = label; gaps hold a default Material named "unlabelled".
std::vector<Material> materials_by_label(const MaterialTable& table);

}  // namespace insonify
