#include "store/materials_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.hpp"
#include "store/toml_tree.hpp"

namespace insonify {
namespace {

constexpr int materials_schema = 1;
constexpr double highest_mu_db = -4.97;  // 1/pi, rounded as it is written in tables

// A surface that sends back more than it receives is refused; -inf is a silent one.
double lambert_mu_of(const std::string& path, const TomlValue& entry) {
  const double mu_db = toml_number(path, entry, "lambert_mu_db");
  if (!(mu_db <= highest_mu_db))
    fail_in_file(path, entry.find("lambert_mu_db")->line, "lambert_mu_db = ", mu_db,
                 " dB, must be at most -4.97 dB (1/pi: no surface sends back more than it receives)");
  return std::min(power_from_db(mu_db), 1 / pi);
}

int label_of(const std::string& path, const TomlValue& entry, std::size_t place) {
  const TomlValue* value = entry.find("label");
  if (!value) return static_cast<int>(place);
  const double label = toml_number(path, entry, "label");
  if (!(label >= 0 && label <= std::numeric_limits<std::uint16_t>::max()) || label != std::floor(label))
    fail_in_file(path, value->line, "label = ", label, ", must be a whole number within 0 and 65535");
  return static_cast<int>(label);
}

SourcedMaterial read_material(const std::string& path, const TomlValue& entry, std::size_t place) {
  if (entry.kind != TomlValue::Kind::table) fail_in_file(path, entry.line, "material must be a table: [[material]]");
  require_known_keys(path, entry, {"name", "label", "lambert_mu_db", "status", "source"});
  SourcedMaterial result;
  result.material.name = toml_text(path, entry, "name");
  result.material.lambert_mu = lambert_mu_of(path, entry);
  result.label = label_of(path, entry, place);
  result.status = entry.find("status") ? toml_text(path, entry, "status") : "user";
  if (entry.find("source")) result.source = toml_text(path, entry, "source");
  return result;
}

}  // namespace

std::vector<SourcedMaterial> load_materials(const std::string& path) {
  const TomlValue document = load_toml(path);
  require_known_keys(path, document, {"schema", "material"});
  if (const double schema = toml_number(path, document, "schema"); schema != materials_schema)
    fail_in_file(path, document.find("schema")->line, "schema = ", schema, ", this insonify reads schema ",
                 materials_schema);
  const TomlValue* list = document.find("material");
  if (!list || list->kind != TomlValue::Kind::array || list->items.empty())
    fail_in_file(path, list ? list->line : 1, "no [[material]] in the file");

  std::vector<SourcedMaterial> materials;
  for (const TomlValue& entry : list->items) {
    const SourcedMaterial next = read_material(path, entry, materials.size());
    for (const SourcedMaterial& other : materials) {
      if (other.material.name == next.material.name)
        fail_in_file(path, entry.line, "material '", next.material.name, "' is listed twice");
      if (other.label == next.label)
        fail_in_file(path, entry.line, "label ", next.label, " of '", next.material.name, "' belongs to '",
                     other.material.name, "' already");
    }
    materials.push_back(next);
  }
  return materials;
}

std::vector<Material> materials_by_label(const std::vector<SourcedMaterial>& materials) {
  Material unlabelled;
  unlabelled.name = "unlabelled";
  std::vector<Material> by_label;
  for (const SourcedMaterial& m : materials) {
    const auto label = static_cast<std::size_t>(m.label);
    if (by_label.size() <= label) by_label.resize(label + 1, unlabelled);
    by_label[label] = m.material;
  }
  return by_label;
}

}  // namespace insonify
