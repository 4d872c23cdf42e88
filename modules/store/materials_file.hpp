#pragma once
#include <string>
#include <vector>

#include "scene/material.hpp"
#include "scene/material_field.hpp"

namespace insonify {

/// A material with the origin of its number.
struct SourcedMaterial {
  Material material;
  int label = 0;  ///< the label in a cloud that means this material
  std::string status, source;
};

/// A file of materials, and how the points of a cloud say which of them they are of.
struct MaterialTable {
  std::vector<SourcedMaterial> materials;
  MaterialField field;  ///< its intervals name materials by label, the index in materials_by_label
};

/// Reads a table of materials from TOML: [[material]] name, the keys of material_numbers, label (its place), status,
/// source. `field` at the top names the scalar field that holds the labels; or each material
/// gives the half-open interval of values that mean it, `from` (included) and `to` (not included), of which one may be
/// left out. Unknown keys, overlapping intervals and numbers that no surface can have are errors with file and line.
MaterialTable load_materials(const std::string& path);

/// Materials ordered so that index = label; gaps are filled by Material{} named "unlabelled".
std::vector<Material> materials_by_label(const MaterialTable& table);

}  // namespace insonify
