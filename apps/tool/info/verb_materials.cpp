// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "store/nearest_word.hpp"
#include "store/run_directory.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "tool/info/material_list.hpp"

namespace insonify::tool {
namespace {

struct MaterialsOptions {
  CommonOptions common;
  std::string name;
  bool toml = false;
};

void add_options(OptionList list, MaterialsOptions& o) {
  list.add("NAME", &o.name, "material, or a .toml file of materials");
  list.add("--toml", &o.toml, "print the file itself, to begin one of your own with");
  add_common(list, o.common);
}

/// The material of a name alone. Throws Error(argument) with the nearest name.
std::vector<SourcedMaterial> find_material(const std::vector<SourcedMaterial>& all, const std::string& name) {
  std::vector<std::string> names;
  for (const SourcedMaterial& m : all) names.push_back(m.material.name);
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end())
    fail(ErrorKind::argument, "material '", name, "' is unknown", did_you_mean(name, names),
         "; see insonify materials");
  return {all[static_cast<std::size_t>(at - names.begin())]};
}

void materials(const MaterialsOptions& o) {
  const bool own = std::filesystem::path(o.name).extension() == ".toml";
  const std::string path = own ? o.name : built_in_materials();
  std::vector<SourcedMaterial> listed = load_materials(path).materials;
  if (!own && !o.name.empty()) listed = find_material(listed, o.name);
  if (o.toml) {
    std::fputs(read_text_file(path).c_str(), stdout);
    return;
  }
  print_result(o.common, materials_json(listed), [&] { print_materials(listed); });
}

}  // namespace

Verb materials_verb() {
  return make_verb<MaterialsOptions>(
      "materials", "the materials that surfaces have by name, with their law, numbers and sources",
      {"insonify materials", "insonify materials sand --json", "insonify materials --toml > my-materials.toml",
       "insonify ping reef.pcd --material sand --sonar p900-45 --pose=-1,4,-2.2,0,15,0 -o out"},
      add_options, materials);
}

}  // namespace insonify::tool
