// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/scene_tags.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/text_lines.hpp"

namespace insonify {
namespace {

/// A material has one line with its first number. A second line, "surface", has the other numbers if any of them is not
/// the default; a third one, "law", a law other than Lambert's.
constexpr std::span surface_numbers = std::span(material_numbers).subspan(1);
constexpr std::size_t first_surface_numbers = 2;  // in every such line: the numbers of the first version

/// Returns the shortest text that reads back as the same double.
std::string exact(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return std::string(text.data(), end);
}

bool is_json_text(std::string_view json, std::string& text) {
  const nlohmann::json value = nlohmann::json::parse(json, nullptr, false);
  if (value.is_string()) text = value.get<std::string>();
  return value.is_string();
}

}  // namespace

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

std::string utf8_text(const std::string& text) { return nlohmann::json::parse(json_text(text)).get<std::string>(); }

const std::string& SceneTags::meant_name(const std::string& in_file) const {
  const auto at = std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.first == in_file; });
  return at == columns.end() ? in_file : at->second;
}

const std::string& SceneTags::name_in_file(const std::string& meant) const {
  const auto at = std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.second == meant; });
  return at == columns.end() ? meant : at->first;
}

/// Reads the numbers of a material's surface. Returns false if they are invalid.
bool read_surface(std::string_view rest, SceneTags& tags) {
  std::size_t index = 0;
  if (!to_number(take_word(rest), index) || index >= tags.materials.size()) return false;
  std::string_view word = take_word(rest);
  for (const MaterialNumber& n : surface_numbers) {
    if (&n > &surface_numbers.front() && word.empty()) break;  // the line is older than this number
    if (!to_number(word, tags.materials[index].*n.member) || tags.materials[index].*n.member > n.most) return false;
    word = take_word(rest);
  }
  return word.empty();
}

void read_tag(const std::string& path, std::string_view line, SceneTags& tags) {
  std::string_view rest = line;
  if (take_word(rest) != "insonify") return;
  const std::string_view key = take_word(rest);
  const auto bad = [&] {
    fail(ErrorKind::content, path, ": cannot understand the comment line '", shown(line),
         "'; it was edited or written by a newer insonify: save the scene again");
  };
  if (key == "scene") {
    if (take_word(rest) != "1") bad();
    tags.prepared = true;
  } else if (key == "normals") {
    const std::string_view value = take_word(rest);
    if (value != "oriented" && value != "unoriented") bad();
    tags.oriented = value == "oriented";
  } else if (key == "origin") {
    Eigen::Vector3d origin;
    for (double& coordinate : origin) {
      if (!to_number(take_word(rest), coordinate)) bad();
    }
    tags.origin = origin;
  } else if (key == "points") {
    tags.heights = take_word(rest) == "heights";
    tags.own_normals = tags.heights && take_word(rest) == "normals";
  } else if (key == "material_field") {
    if (!rest.empty()) rest.remove_prefix(1);
    tags.material_field = std::string(rest);
  } else if (key == "system") {
    if (!is_json_text(rest, tags.system)) bad();
  } else if (key == "levels_of") {
    tags.levels_of = take_word(rest);
  } else if (key == "column") {
    const std::string_view name = take_word(rest);
    std::string meant;
    if (!is_json_text(rest, meant)) bad();
    tags.columns.emplace_back(name, meant);
  } else if (key == "material") {
    std::size_t index = 0;
    Material material;
    if (!to_number(take_word(rest), index) || index != tags.materials.size()) bad();
    if (!to_number(take_word(rest), material.*material_numbers[0].member)) bad();
    if (!rest.empty()) rest.remove_prefix(1);
    material.name = std::string(rest);
    tags.materials.push_back(material);
  } else if (key == "law") {
    std::size_t index = 0;
    if (!to_number(take_word(rest), index) || index >= tags.materials.size()) bad();
    const std::optional<SurfaceLaw> law = law_from_text(rest);
    if (!law || !problem_of(*law).empty()) bad();
    tags.materials[index].law = *law;
  } else if (key == "surface") {
    if (!read_surface(rest, tags)) bad();
  }
}

std::vector<std::string> tag_lines(const SceneCloud& scene, const std::string& system) {
  std::vector<std::string> lines = {"insonify scene 1"};
  lines.push_back("insonify origin " + exact(scene.origin.x()) + " " + exact(scene.origin.y()) + " " +
                  exact(scene.origin.z()));
  lines.push_back(scene.normals_oriented ? "insonify normals oriented" : "insonify normals unoriented");
  if (!system.empty()) lines.push_back("insonify system " + json_text(system));
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    std::string name = scene.materials[m].name;
    for (char& c : name) {
      if (c == '\n' || c == '\r') c = ' ';
    }
    const Material& material = scene.materials[m];
    const std::string index = std::to_string(m);
    lines.push_back("insonify material " + index + " " + exact(material.*material_numbers[0].member) + " " + name);
    // List the numbers up to the last one that is not the default.
    std::size_t said = 0;
    std::string surface = "insonify surface " + index;
    for (std::size_t k = 0; k < surface_numbers.size(); ++k)
      if (material.*surface_numbers[k].member != Material{}.*surface_numbers[k].member) said = k + 1;
    for (const MaterialNumber& n : surface_numbers.first(std::max(said, first_surface_numbers)))
      surface += " " + exact(material.*n.member);
    if (said > 0) lines.push_back(surface);
    if (material.law != SurfaceLaw{}) lines.push_back("insonify law " + index + " " + law_to_text(material.law));
  }
  return lines;
}

}  // namespace insonify
