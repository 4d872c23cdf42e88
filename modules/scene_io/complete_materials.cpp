// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "core/error.hpp"
#include "core/message.hpp"
#include "scene_io/complete_scene_internal.hpp"

namespace insonify {
namespace {

/// Assigns one material to all surfels.
void give_one_material(std::uint16_t index, SceneCloud& scene) {
  if (scene.materials.empty()) scene.materials = {Material{}};
  if (index >= scene.materials.size()) {
    fail(ErrorKind::argument, "load_scene: options.material = ", index, ", must be below the number of materials, ",
         scene.materials.size(), "; give options.materials too");
  }
  scene.material.assign(scene.point.size(), index);
}

/// Assigns an extra material to surfels whose value lies in no interval, and counts them.
void place_outsiders(const LoadOptions& options, const RawCloud& raw, LoadedScene& result) {
  SceneCloud& scene = result.scene;
  const auto outsiders = std::count(scene.material.begin(), scene.material.end(), no_label);
  if (outsiders == 0) return;
  const auto outside = static_cast<std::uint16_t>(scene.materials.size());
  std::replace(scene.material.begin(), scene.material.end(), no_label, outside);
  scene.materials.push_back({.name = "outside"});
  result.report.outside_intervals = static_cast<std::size_t>(outsiders);
  result.report.notes.push_back(
      share(result.report.outside_intervals, scene.size(), raw.triangle.empty() ? "surfels" : "corners") + " have a '" +
      raw.label_field + "' in none of the " + std::to_string(options.material_field.intervals.size()) +
      " intervals: their Lambert coefficient is the default, -27 dB");
}

/// Returns the table of materials: the caller's, whose indices are the file's numbers. If the file names its materials,
/// and the caller's table has one of these names, returns the file's table, with the caller's values for materials of
/// the same name.
std::vector<Material> materials_of(const RawCloud& raw, const LoadOptions& options, LoadReport& report) {
  std::vector<Material> own = raw.tags.materials;
  if (options.materials.empty()) return own;
  if (options.material || !options.material_field.intervals.empty()) return options.materials;
  std::vector<std::string> missing;
  bool known = false;
  for (Material& material : own) {
    if (material.name == "unlabelled") continue;  // name of the gaps between labels
    const auto same = std::find_if(options.materials.begin(), options.materials.end(),
                                   [&](const Material& other) { return other.name == material.name; });
    if (same != options.materials.end())
      material = *same, known = true;
    else
      missing.push_back(material.name);
  }
  if (!known && !raw.material_names.empty() && missing != std::vector<std::string>{Material{}.name}) {
    const std::string none = "the table of materials has none of the names in the file: " + shortened_list(missing);
    if (options.materials.size() < own.size())
      fail(ErrorKind::content, raw.path, ": ", none, "; give laws to these names, or one material for all");
    report.notes.push_back(none + "; they take its rows in this order");
  }
  if (!known) return options.materials;
  if (!missing.empty())
    report.notes.push_back("the table of materials has no " + shortened_list(missing) + ": as in the file");
  return own;
}

}  // namespace

std::string label_problem(const RawCloud& raw, const std::vector<Material>& table, std::uint16_t largest) {
  if (largest == no_label)
    return "a label is negative, above 65534 or not an integer; labels are indices of materials from 0: correct them, "
           "give one material for all, or map intervals of field '" +
           raw.label_field + "' to materials";
  if (!table.empty() && largest >= table.size())
    return "label " + std::to_string(largest) + " found, but there are " + std::to_string(table.size()) +
           " materials (labels from 0); give a material for every label";
  return {};
}

void complete_materials(const RawCloud& raw, const LoadOptions& options, LoadedScene& result) {
  SceneCloud& scene = result.scene;
  const std::vector<std::uint16_t>& labels = scene.material;
  scene.materials = materials_of(raw, options, result.report);
  result.report.materials_found = !labels.empty() || !raw.tags.materials.empty();
  if (options.material || labels.empty()) return give_one_material(options.material.value_or(0), scene);
  result.report.material_field = raw.label_field;
  if (!options.material_field.intervals.empty()) return place_outsiders(options, raw, result);
  const std::uint16_t largest = *std::max_element(labels.begin(), labels.end());
  if (const std::string problem = label_problem(raw, scene.materials, largest); !problem.empty())
    fail(ErrorKind::content, raw.path, ": ", problem);
  if (scene.materials.empty()) {
    for (std::size_t m = 0; m <= largest; ++m) scene.materials.push_back({.name = "label " + std::to_string(m)});
    if (largest > 0) {
      result.report.notes.push_back("labels 0 to " + std::to_string(largest) +
                                    " found, but no materials given: all have the default Lambert coefficient");
    }
  }
}

}  // namespace insonify
