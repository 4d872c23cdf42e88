// SPDX-License-Identifier: BSD-3-Clause
#include "store/material_library.hpp"

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "store/material_keys_internal.hpp"
#include "store/nearest_word.hpp"
#include "store/sonar_file.hpp"
#include "store/sourced_values_internal.hpp"

namespace insonify {
namespace {

namespace fs = std::filesystem;

std::vector<SourcedMaterial> lambert_table() { return load_materials(path_of_materials("")).materials; }

std::string file_of(const std::string& stem) {
  return (fs::path(data_folder()) / "materials" / (stem + ".toml")).string();
}

/// Returns the names of the files without their law, sorted.
std::vector<std::string> stems() {
  std::vector<std::string> found;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(data_folder()) / "materials", ignored))
    if (entry.path().extension() == ".toml") found.push_back(entry.path().stem().string());
  std::ranges::sort(found);
  return found;
}

/// Returns the material of a file once for each of its laws; a sediment has two.
std::vector<MaterialFile> by_each_law(const std::string& stem) {
  std::vector<MaterialFile> all;
  const MaterialFile file = load_material_file(file_of(stem));
  for (const SurfaceLaw& law : laws_alike(file.material.law)) {
    all.push_back(file);
    all.back().material.law = law;
    all.back().material.name = stem + "@" + name_of(law);
  }
  return all;
}

}  // namespace

std::string path_of_materials(const std::string& name) {
  return name.empty() ? data_folder() + "/materials.toml" : name == "natural" ? data_folder() + "/natural.toml" : name;
}

MaterialFile load_material_file(const std::string& path) {
  TomlValue table = load_toml(path);
  require_schema(path, table, 1);
  MaterialFile file;
  file.path = path;
  if (const TomlValue* text = table.find("description")) file.description = text->text;
  file.numbers = take_sources(path, table);
  std::erase_if(file.numbers, [](const SourcedNumber& n) {
    return n.key == "schema" || n.key == "name" || n.key == "description" || n.key == "law";
  });
  MaterialEntry entry;
  read_material(path, table, entry, find_material, {"schema", "description"});
  file.material = entry.sourced.material;
  return file;
}

std::vector<MaterialFile> list_materials() {
  std::vector<MaterialFile> all;
  for (const std::string& stem : stems())
    for (MaterialFile& file : by_each_law(stem)) all.push_back(std::move(file));
  return all;
}

std::vector<std::string> material_names() {
  std::vector<std::string> names;
  for (const SourcedMaterial& m : lambert_table()) names.push_back(m.material.name);
  const std::vector<std::string> lambert = names;
  for (const MaterialFile& file : list_materials()) {
    const std::string &name = file.material.name, stem = name.substr(0, name.find('@'));
    names.push_back(name);
    if (std::ranges::find(names, stem) == names.end()) names.push_back(stem);
  }
  return names;
}

MaterialFile find_material_file(const std::string& name) {
  const std::string stem = name.substr(0, name.find('@'));
  const std::vector<std::string> known = stems();
  if (std::ranges::find(known, stem) != known.end())
    for (const MaterialFile& file : by_each_law(stem))
      if (name == stem || name == file.material.name) return file;
  fail(ErrorKind::argument, "material '", name, "' is unknown", did_you_mean(name, material_names()),
       "; see insonify materials");
}

Material find_material(const std::string& name) {
  for (const SourcedMaterial& m : lambert_table())
    if (m.material.name == name) return m.material;
  return find_material_file(name).material;
}

}  // namespace insonify
