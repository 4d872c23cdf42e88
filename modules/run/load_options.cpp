// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "run/parse_values.hpp"
#include "run/ping_setup.hpp"
#include "store/material_library.hpp"
#include "store/materials_file.hpp"
#include "store/nearest_word.hpp"

namespace insonify {
namespace {

/// Index of the material called `name`, which is added if insonify knows it; Error(argument) with the nearest name.
std::uint16_t material_index(std::vector<Material>& materials, const std::string& name) {
  std::vector<std::string> names = words_of(materials);
  const auto at = std::find(names.begin(), names.end(), name);
  if (at != names.end()) return static_cast<std::uint16_t>(at - names.begin());
  const std::vector<std::string> built_in = material_names();
  names.insert(names.end(), built_in.begin(), built_in.end());
  if (std::find(built_in.begin(), built_in.end(), name) == built_in.end())
    fail(ErrorKind::argument, "--material = '", name, "' is unknown", did_you_mean(name, names),
         "; see insonify materials");
  materials.push_back(find_material(name));
  return static_cast<std::uint16_t>(materials.size() - 1);
}

}  // namespace

LoadOptions load_options(const SceneOptions& scene, std::uint64_t seed, int threads) {
  LoadOptions options;
  options.seed = seed;
  options.threads = threads;
  options.meaning = scene.meaning;
  options.mesh_spacing = scene.mesh_spacing;
  options.scan_noise = scene.scan_noise;
  for (const auto& [option, value] :
       {std::pair("--mesh-spacing", options.mesh_spacing), std::pair("--scan-noise", options.scan_noise.value_or(0))})
    if (!(value >= 0 && std::isfinite(value)))
      fail(ErrorKind::argument, option, " = ", value, " m, must be 0 or more, and finite");
  options.keep_strays = scene.keep_strays;
  options.viewpoint = scene.viewpoint;
  if (!scene.materials_file.empty() || !scene.material.empty()) {
    const MaterialTable table = load_materials(path_of_materials(scene.materials_file));
    options.materials = materials_by_label(table);
    options.material_field = table.field;
  }
  if (!scene.material_field.empty()) options.material_field.name = scene.material_field;
  if (!scene.material.empty()) options.material = material_index(options.materials, scene.material);
  return options;
}

std::vector<std::string> loading_notes(const LoadReport& r) {
  std::vector<std::string> notes;
  const auto count = [&](std::size_t n, const char* what) {
    if (n > 0) notes.push_back(fmt::format("{}: {} {}", r.path, n, what));
  };
  count(r.dropped_not_finite, "points dropped, whose coordinates are NaN, infinite or beyond 1e9 m");
  count(r.dropped_withheld, "points dropped, which the file marks as withheld");
  count(r.dropped_classes, "points dropped, whose class is not read");
  count(r.dropped_duplicates, "duplicate points dropped");
  count(r.dropped_degenerate, "degenerate triangles dropped");
  count(r.repaired_normals, "zero or NaN normals replaced by estimates");
  count(r.dropped_without_normal, "points dropped, which have too few neighbours for a normal");
  for (const std::string& note : r.notes) notes.push_back(r.path + ": " + note);
  return notes;
}

}  // namespace insonify
