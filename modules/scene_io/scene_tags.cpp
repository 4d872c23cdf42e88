#include <array>
#include <charconv>

#include "core/error.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/text_lines_internal.hpp"

namespace insonify {
namespace {

/// Shortest text that reads back as the same double.
std::string exact(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return std::string(text.data(), end);
}

}  // namespace

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
  } else if (key == "material") {
    std::size_t index = 0;
    Material material;
    if (!to_number(take_word(rest), index) || index != tags.materials.size()) bad();
    if (!to_number(take_word(rest), material.lambert_mu)) bad();
    if (!rest.empty()) rest.remove_prefix(1);
    material.name = std::string(rest);
    tags.materials.push_back(material);
  } else if (key == "surface") {
    std::size_t index = 0;
    if (!to_number(take_word(rest), index) || index >= tags.materials.size()) bad();
    Material& material = tags.materials[index];
    if (!to_number(take_word(rest), material.coherent_fraction)) bad();
    if (!to_number(take_word(rest), material.relief_slope)) bad();
  }
}

std::vector<std::string> tag_lines(const SceneCloud& scene) {
  std::vector<std::string> lines = {"insonify scene 1"};
  lines.push_back("insonify origin " + exact(scene.origin.x()) + " " + exact(scene.origin.y()) + " " +
                  exact(scene.origin.z()));
  lines.push_back(scene.normals_oriented ? "insonify normals oriented" : "insonify normals unoriented");
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    std::string name = scene.materials[m].name;
    for (char& c : name) {
      if (c == '\n' || c == '\r') c = ' ';
    }
    const Material& material = scene.materials[m];
    lines.push_back("insonify material " + std::to_string(m) + " " + exact(material.lambert_mu) + " " + name);
    if (material.coherent_fraction == 0 && material.relief_slope == 0) continue;
    lines.push_back("insonify surface " + std::to_string(m) + " " + exact(material.coherent_fraction) + " " +
                    exact(material.relief_slope));
  }
  return lines;
}

}  // namespace insonify
