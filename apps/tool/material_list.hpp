#pragma once
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "scene/scene_cloud.hpp"
#include "store/materials_file.hpp"

/// Materials as the tool lists them: names, numbers and sources of a table, shares of a scene.
namespace insonify::tool {

/// Path of the table that is part of insonify.
std::string built_in_materials();

/// A list of name, label, the numbers under the keys of material files, status and source.
nlohmann::ordered_json materials_json(const std::vector<SourcedMaterial>& materials);

/// Prints a table of them, and the law that the numbers belong to.
void print_materials(const std::vector<SourcedMaterial>& materials);

/// For each material of the surfels of a scene: name, surfels, area_m2 and share, of the whole area.
nlohmann::ordered_json material_shares(const SceneCloud& scene);

}  // namespace insonify::tool
