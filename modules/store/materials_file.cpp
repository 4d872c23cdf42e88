#include "store/materials_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.hpp"
#include "store/toml_tree_internal.hpp"

namespace insonify {
namespace {

constexpr int materials_schema = 1;

/// Takes a number of a material from its key. In decibels -inf means 0, and the limit is rounded up to 0.01 dB, as it is
/// written in tables of materials.
void read_number(const std::string& path, const TomlValue& entry, const MaterialNumber& n, Material& material) {
  const TomlValue* value = entry.find(n.key);
  if (!value && !n.required) return;
  const double number = toml_number(path, entry, n.key);
  const std::string note = *n.note ? std::string(" (") + n.note + ")" : "";
  const double most = n.in_decibels ? std::ceil(100 * db_from_power(n.most_in_files)) / 100 : n.most_in_files;
  if (n.in_decibels && !(number <= most))
    fail_in_file(path, value->line, n.key, " = ", number, " dB, must be at most ", most, " dB", note);
  if (!n.in_decibels && !(number >= 0 && number <= most))
    fail_in_file(path, value->line, n.key, " = ", number, ", must be within 0 and ", most, note);
  material.*n.member = n.in_decibels ? std::min(power_from_db(number), n.most_in_files) : number;
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
  std::vector<std::string> keys = {"name", "label", "from", "to", "status", "source"};
  for (const MaterialNumber& n : material_numbers) keys.push_back(n.key);
  require_known_keys(path, entry, keys);
  SourcedMaterial result;
  result.material.name = toml_text(path, entry, "name");
  for (const MaterialNumber& n : material_numbers) read_number(path, entry, n, result.material);
  result.label = label_of(path, entry, place);
  result.status = entry.find("status") ? toml_text(path, entry, "status") : "user";
  if (entry.find("source")) result.source = toml_text(path, entry, "source");
  return result;
}

/// Adds the interval of a material that has one; [from, to) must not overlap earlier ones.
void read_interval(const std::string& path, const TomlValue& entry, const SourcedMaterial& of, MaterialTable& table) {
  MaterialInterval next;
  const TomlValue *from = entry.find("from"), *to = entry.find("to");
  if (!from && !to) return;
  if (from) next.from = toml_number(path, entry, "from");
  if (to) next.to = toml_number(path, entry, "to");
  next.material = static_cast<std::uint16_t>(of.label);
  const int line = (from ? from : to)->line;
  if (!(next.from < next.to))
    fail_in_file(path, line, "from = ", next.from, " of '", of.material.name, "', must be below to = ", next.to);
  for (const MaterialInterval& other : table.field.intervals)
    if (next.from < other.to && other.from < next.to)
      fail_in_file(path, line, "interval ", next.from, " .. ", next.to, " of '", of.material.name, "' overlaps ",
                   other.from, " .. ", other.to, ", listed before; each value must belong to one material");
  table.field.intervals.push_back(next);
}

/// Refuses a name or label that is already in the table.
void require_new(const std::string& path, int line, const SourcedMaterial& next, const MaterialTable& table) {
  for (const SourcedMaterial& other : table.materials) {
    if (other.material.name == next.material.name)
      fail_in_file(path, line, "material '", next.material.name, "' is listed twice");
    if (other.label == next.label)
      fail_in_file(path, line, "label ", next.label, " of '", next.material.name, "' belongs to '", other.material.name,
                   "' already");
  }
}

}  // namespace

MaterialTable load_materials(const std::string& path) {
  const TomlValue document = load_toml(path);
  require_known_keys(path, document, {"schema", "field", "material"});
  if (const double schema = toml_number(path, document, "schema"); schema != materials_schema)
    fail_in_file(path, document.find("schema")->line, "schema = ", schema, ", this version reads schema ",
                 materials_schema);
  const TomlValue* list = document.find("material");
  if (!list || list->kind != TomlValue::Kind::array || list->items.empty())
    fail_in_file(path, list ? list->line : 1, "no [[material]] in the file");

  MaterialTable table;
  if (document.find("field")) table.field.name = toml_text(path, document, "field");
  for (const TomlValue& entry : list->items) {
    const SourcedMaterial next = read_material(path, entry, table.materials.size());
    require_new(path, entry.line, next, table);
    read_interval(path, entry, next, table);
    table.materials.push_back(next);
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

}  // namespace insonify
