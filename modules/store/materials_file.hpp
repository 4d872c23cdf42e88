#pragma once
#include <string>
#include <vector>

#include "scene/material.hpp"

namespace insonify {

/// A material with the origin of its number.
struct SourcedMaterial {
  Material material;
  int label = 0;  ///< the label in a cloud that means this material
  std::string status, source;
};

/// Reads a table of materials from TOML: [[material]] name, lambert_mu_db, label (default: its place),
/// status, source. Unknown keys are errors with file, line and the nearest known key.
std::vector<SourcedMaterial> load_materials(const std::string& path);

/// Materials ordered so that index = label; gaps are filled by Material{} named "unlabelled".
std::vector<Material> materials_by_label(const std::vector<SourcedMaterial>& materials);

}  // namespace insonify
