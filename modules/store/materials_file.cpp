// SPDX-License-Identifier: BSD-3-Clause
#include "store/materials_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "acoustics/surface_laws.hpp"
#include "core/error.hpp"
#include "store/material_keys_internal.hpp"
#include "store/material_library.hpp"
#include "store/nearest_word.hpp"
#include "store/sonar_file.hpp"
#include "store/sourced_values_internal.hpp"

namespace insonify {
namespace {

constexpr int materials_schema = 1;

/// Adds the interval of a material that has one; [from, to) must not overlap earlier ones.
void add_interval(const std::string& path, const TomlValue& entry, const MaterialEntry& of, MaterialTable& table) {
  const TomlValue *from = entry.find("from"), *to = entry.find("to");
  if (!from && !to) return;
  MaterialInterval next = of.interval;
  next.material = static_cast<std::uint16_t>(of.sourced.label);
  const int line = (from ? from : to)->line;
  const std::string& name = of.sourced.material.name;
  if (!(next.from < next.to))
    fail_in_file(path, line, "from = ", next.from, " of '", name, "', must be below to = ", next.to);
  for (const MaterialInterval& other : table.field.intervals)
    if (next.from < other.to && other.from < next.to)
      fail_in_file(path, line, "interval ", next.from, " .. ", next.to, " of '", name, "' overlaps ", other.from,
                   " .. ", other.to, ", listed before; each value must belong to one material");
  table.field.intervals.push_back(next);
}

/// The materials of one file that were read so far.
struct Listed {
  std::set<std::string> names;
  std::map<int, std::string> name_of_label;
  std::map<std::string, Material> liked;  // materials of the library, each read once
  std::vector<Material> checked;          // one material of each law
  std::size_t frequencies = 0;            // number of frequencies at which laws were checked
};

/// Throws Error(content) for a name or label that is already in the table.
void require_new(const std::string& path, int line, const SourcedMaterial& next, Listed& listed) {
  const std::string& name = next.material.name;
  if (!listed.names.insert(name).second) fail_in_file(path, line, "material '", name, "' is listed twice");
  if (const auto [other, is_new] = listed.name_of_label.try_emplace(next.label, name); !is_new)
    fail_in_file(path, line, "label ", next.label, " of '", name, "' belongs to '", other->second, "' already");
}

/// Throws Error(content) for a law that creates energy. Equal laws are checked once, in up to 20 ms for each frequency.
void require_energy(const std::string& path, int line, const Material& material, Listed& listed) {
  constexpr std::size_t most_frequencies = 256, untabulated = 3;
  const auto* table = std::get_if<TableLaw>(&material.law);
  const auto same_law = [&](const Material& other) { return other.law == material.law; };
  if (std::holds_alternative<LambertLaw>(material.law) || std::ranges::any_of(listed.checked, same_law)) return;
  listed.frequencies += table && !table->frequency.empty() ? table->frequency.size() : untabulated;
  if (listed.frequencies > most_frequencies)
    fail_in_file(path, line, "the laws of the materials up to '", material.name, "' have more than ", most_frequencies,
                 " frequencies, 3 for each law without a table; list fewer, or less densely");
  require_energy(material, (path + ":" + std::to_string(line)).c_str(), ErrorKind::content);
  listed.checked.push_back(material);
}

std::vector<SourcedMaterial> lambert_table() { return load_materials(path_of_materials("")).materials; }

/// Returns the material of a file once for each of its laws; a sediment has two.
std::vector<MaterialFile> by_each_law(const std::string& stem, const std::string& path) {
  std::vector<MaterialFile> all;
  const MaterialFile file = load_material_file(path);
  for (const SurfaceLaw& law : laws_alike(file.material.law)) {
    all.push_back(file);
    all.back().material.law = law;
    all.back().material.name = stem + "@" + name_of(law);
  }
  return all;
}

}  // namespace

MaterialTable load_materials(const std::string& path) {
  const TomlValue document = load_toml(path);
  require_schema(path, document, materials_schema);
  MaterialTable table;
  read_keys(path, document,
            {{"", "field", "", text(table.field.name), "field of the cloud that encodes materials"},
             {"", "material", "", list_of_tables(), "", true}},
            "", {"schema"});
  Listed listed;
  const auto find_like = [&](const std::string& name) {
    const auto [found, is_new] = listed.liked.try_emplace(name);
    if (is_new) found->second = find_material(name);
    return found->second;
  };
  for (const TomlValue& item : document.find("material")->items) {
    MaterialEntry entry;
    entry.sourced.label = static_cast<int>(table.materials.size());
    entry.sourced.status = "user";
    read_material(path, item, entry, find_like);
    require_energy(path, item.line, entry.sourced.material, listed);
    require_new(path, item.line, entry.sourced, listed);
    add_interval(path, item, entry, table);
    table.materials.push_back(entry.sourced);
  }
  return table;
}

std::vector<Material> materials_by_label(const MaterialTable& table) {
  Material unlabelled;
  unlabelled.name = "unlabelled";
  std::vector<Material> by_label;
  for (const SourcedMaterial& m : table.materials) {
    const auto label = static_cast<std::size_t>(m.label);
    if (by_label.size() <= label) by_label.resize(label + 1, unlabelled);
    by_label[label] = m.material;
  }
  return by_label;
}

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
  for (const auto& [stem, path] : data_files("materials"))
    for (MaterialFile& file : by_each_law(stem, path)) all.push_back(std::move(file));
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
  const auto known = data_files("materials");
  if (const auto found = known.find(stem); found != known.end())
    for (const MaterialFile& file : by_each_law(stem, found->second))
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
