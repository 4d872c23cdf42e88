// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/text.hpp"
#include "run/parse_values.hpp"
#include "scene/objects.hpp"
#include "scene_io/save_cloud.hpp"
#include "store/material_library.hpp"
#include "store/nearest_word.hpp"
#include "store/run_directory.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "tool/scene/object_list.hpp"

namespace insonify::tool {
namespace {

struct MakeObjectOptions {
  CommonOptions common;
  std::string name;
  std::string output;
  std::vector<std::string> set;
  std::vector<std::string> materials;
  bool list = false;
  bool force = false;
};

void add_options(OptionList list, MakeObjectOptions& o) {
  list.add("NAME", &o.name, "cylinder-mine, tyre, crab-pot ...; without a name, all objects are listed");
  list.add("-o,--output", &o.output, "mesh that is written, .ply");
  list.add("--set", &o.set, "KEY=VALUE of an option of the object, e.g. diameter_m=0.7; may be given several times",
           {.one_each = true, .shown_as = "KEY=VALUE"});
  list.add("--material", &o.materials,
           "NAME of one material for the whole object, or OLD=NEW to replace a material; `insonify materials` lists "
           "the names",
           {.one_each = true, .shown_as = "NAME"});
  list.add("--list", &o.list, "list the objects, or the options of NAME");
  list.add("--force", &o.force, "replace an existing file");
  add_common(list, o.common);
}

const ObjectKind& kind_of(const std::string& name) {
  const std::vector<std::string> names = words_of(object_kinds());
  const ObjectKind* kind = find_object(name);
  if (!kind)
    fail(ErrorKind::argument, "no object '", name, "', must be one of: ", joined(names), did_you_mean(name, names));
  return *kind;
}

ObjectSettings settings_of(const ObjectKind& kind, const std::vector<std::string>& set) {
  std::vector<std::string> keys;
  for (const ObjectOption& option : options_of(kind)) keys.emplace_back(option.key);
  ObjectSettings settings;
  for (const std::string& text : set) {
    const std::size_t equal = text.find('=');
    const std::string key = text.substr(0, equal);
    if (equal == text.npos)
      fail(ErrorKind::argument, "--set ", text, ": must be KEY=VALUE, e.g. --set ", keys.front(), "=1");
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      fail(ErrorKind::argument, "--set ", text, ": ", kind.name, " has no option '", key,
           "', must be one of: ", joined(keys), did_you_mean(key, keys));
    settings.emplace_back(key, parse_number("--set " + key, text.substr(equal + 1)));
  }
  return settings;
}

/// The names of the materials after --material, in the order of the object's own.
std::vector<std::string> names_after(const std::vector<std::string>& options, const std::vector<Material>& own) {
  const std::vector<std::string> before = words_of(own);
  std::vector<std::string> names = before;
  for (const std::string& option : options) {
    const std::size_t equal = option.find('=');
    if (equal == option.npos) {
      names.assign(names.size(), option);
      continue;
    }
    const auto old = std::find(before.begin(), before.end(), option.substr(0, equal));
    if (old == before.end())
      fail(ErrorKind::argument, "--material ", option, ": nothing is made of '", option.substr(0, equal),
           "', it is made of: ", joined(before));
    names[static_cast<std::size_t>(old - before.begin())] = option.substr(equal + 1);
  }
  return names;
}

/// Gives the mesh the materials of the library by their names, each of them once.
void set_materials(const std::vector<std::string>& options, SceneMesh& mesh) {
  std::vector<Material> materials;
  std::vector<std::uint16_t> index;
  for (const std::string& name : names_after(options, mesh.materials)) {
    const Material material = find_material(name);
    const auto same = std::find(materials.begin(), materials.end(), material);
    index.push_back(static_cast<std::uint16_t>(same - materials.begin()));
    if (same == materials.end()) materials.push_back(material);
  }
  for (std::uint16_t& m : mesh.material) m = index[m];
  mesh.materials = materials;
}

void list_objects(const MakeObjectOptions& o) {
  if (!o.set.empty() || !o.materials.empty() || !o.output.empty())
    fail(ErrorKind::argument, o.name.empty() ? "which object? give NAME before " : "--list writes nothing; leave out ",
         !o.output.empty() ? "-o"
         : !o.set.empty()  ? "--set"
                           : "--material");
  nlohmann::ordered_json json;
  if (o.name.empty())
    for (const ObjectKind& kind : object_kinds()) json.push_back(object_json(kind));
  else
    json = object_json(kind_of(o.name));
  print_result(o.common, json, [&] { o.name.empty() ? print_objects() : print_object(kind_of(o.name)); });
}

void make_object_file(const MakeObjectOptions& o) {
  if (o.name.empty() || o.list) return list_objects(o);
  const ObjectKind& kind = kind_of(o.name);
  const ObjectSettings settings = settings_of(kind, o.set);
  if (o.output.empty())
    fail(ErrorKind::argument, "-o is missing: the file to write, e.g. -o ", kind.name,
         ".ply; --list lists the options");
  require_free_file(o.output, o.force, {});
  SceneMesh mesh = make_object(kind.name, settings);
  set_materials(o.materials, mesh);
  save_mesh(o.output, mesh);

  double area = 0;
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) area += area_of(corners_of(mesh, t));
  const Eigen::Vector3d size = size_of(mesh);
  const std::vector<std::string> materials = words_of(mesh.materials);
  print_summary(o.common,
                {{"output", o.output},
                 {"object", kind.name},
                 {"size_m", {size.x(), size.y(), size.z()}},
                 {"triangles", mesh.triangle.size()},
                 {"area_m2", area},
                 {"materials", materials}},
                fmt::format("{}: {} of {} m, {} triangles, {:.4g} m^2, {}", o.output, kind.name, size_text(mesh),
                            mesh.triangle.size(), area, joined(materials)));
}

}  // namespace

Verb make_object_verb() {
  return make_verb<MakeObjectOptions>("make-object", "a mine, tyre, drum, crab pot, diver ... as a mesh with materials",
                                      {"insonify make-object", "insonify make-object tyre --list",
                                       "insonify make-object tyre -o tyre.ply --set diameter_m=0.7 --set upright=1",
                                       "insonify make-object cylinder-mine -o mine.ply --material steel@rough"},
                                      add_options, make_object_file);
}

}  // namespace insonify::tool
