// SPDX-License-Identifier: BSD-3-Clause
#include "store/materials_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "store/material_keys_internal.hpp"

namespace insonify {
namespace {

constexpr int materials_schema = 1;

/// A number of a material. In decibels -inf means 0, and the limit is rounded up to 0.01 dB, as it is written in tables
/// of materials.
KeyValue number_of(Material& material, const MaterialNumber& n) {
  if (*n.word) {
    const bool flag = n.word == std::string("true");
    const auto set = [&number = material.*n.member, &n, flag](const TomlValue& value, const std::string&) {
      number = flag ? value.number : value.text == n.word;
      return value.kind == (flag ? TomlValue::Kind::boolean : TomlValue::Kind::text) && (flag || number > 0);
    };
    return {flag ? "true or false" : '"' + std::string(n.word) + '"', set, [] { return std::optional<std::string>(); }};
  }
  if (!n.in_decibels) return number(at(material.*n.member), {.least = 0, .most = n.most_in_files, .note = n.note});
  Number power = at(material.*n.member);
  power.set = [set = power.set, most = n.most_in_files](double x) { set(std::min(x, most)); };
  const double most = std::ceil(100 * db_from_power(n.most_in_files)) / 100;
  return number(power, {.most = most, .infinite = true, .note = n.note}, in_decibels);
}

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

std::vector<Key> material_keys(MaterialEntry& entry) {
  Material& material = entry.sourced.material;
  std::vector<Key> keys = {{"material", "name", "", text(material.name), "", true}};
  for (const MaterialNumber& n : material_numbers)
    keys.push_back({"material", n.key, n.in_decibels ? "dB" : n.unit, number_of(material, n), n.help, n.required});
  const NumberRule label{.least = 0, .most = std::numeric_limits<std::uint16_t>::max(), .whole = true},
      any{.infinite = true};
  keys.insert(
      keys.end(),
      {
          {"material", "label", "", number(at(entry.sourced.label), label),
           "in the cloud; default: its position in the file"},
          {"material", "from", "", number(at(entry.interval.from), any),
           "or an interval of field values: from (included)"},
          {"material", "to", "", number(at(entry.interval.to), any), "to (excluded); one of the two may be omitted"},
          {"material", "status", "", text(entry.sourced.status), "of the values: sourced, derived, user, ..."},
          {"material", "source", "", text(entry.sourced.source), "where they come from"},
      });
  return keys;
}

MaterialTable load_materials(const std::string& path) {
  const TomlValue document = load_toml(path);
  require_schema(path, document, materials_schema);
  MaterialTable table;
  read_keys(path, document,
            {{"", "field", "", text(table.field.name), "field of the cloud that encodes materials"},
             {"", "material", "", list_of_tables(), "", true}},
            "", {"schema"});
  for (const TomlValue& item : document.find("material")->items) {
    MaterialEntry entry;
    entry.sourced.label = static_cast<int>(table.materials.size());
    entry.sourced.status = "user";
    read_keys(path, item, material_keys(entry), "material");
    require_new(path, item.line, entry.sourced, table);
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

}  // namespace insonify
