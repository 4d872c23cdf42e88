// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "acoustics/surface_laws.hpp"
#include "store/material_keys_internal.hpp"

namespace insonify {
namespace {

constexpr Scale in_kilohertz{[](double x) { return 1e3 * x; }, [](double x) { return 1e-3 * x; }};

/// Returns a number of a material. In decibels -inf means 0, and the limit is rounded up to 0.01 dB, the precision of
/// tables of materials.
KeyValue number_of(Material& material, const MaterialNumber& n) {
  if (*n.word) {
    const bool flag = n.word == std::string("true");
    const auto set = [&number = material.*n.member, &n, flag](const TomlValue& value, const std::string&) {
      number = flag ? value.number : value.text == n.word;
      return value.kind == (flag ? TomlValue::Kind::boolean : TomlValue::Kind::text) && (flag || number > 0);
    };
    return {flag ? "true or false" : '"' + std::string(n.word) + '"', set, [] { return std::optional<std::string>(); }};
  }
  if (!n.in_decibels) return number(material.*n.member, {.least = 0, .most = n.most_in_files, .note = n.note});
  Member<double> power = material.*n.member;
  power.set = [set = power.set, most = n.most_in_files](double x) { set(std::min(x, most)); };
  const double most = std::ceil(100 * db_from_power(n.most_in_files)) / 100;
  return number(power, {.most = most, .infinite = true, .note = n.note}, in_decibels);
}

KeyValue number_of(std::optional<double>& x, const LawNumber& n) {
  if (n.in_decibels) return number(x, {.most = db_from_power(n.most), .infinite = true}, in_decibels);
  const auto get = [&x, n] { return x ? std::optional(*x * n.in_file) : std::nullopt; };
  return number({get, [&x, n](double value) { x = value / n.in_file; }},
                {.least = n.least * n.in_file, .most = n.most * n.in_file, .above = n.above});
}

/// Returns the law of an entry: the numbers given in the file, else those of `like`. `line(key)` is the key's line.
template <typename Line>
SurfaceLaw law_of(const std::string& path, const MaterialEntry& entry, int begin, const Line& line) {
  SurfaceLaw law = entry.law.empty() ? entry.sourced.material.law : *law_named(entry.law);
  const bool complete = !entry.like.empty() && law.index() == entry.sourced.material.law.index();
  if (complete) law = entry.sourced.material.law;
  for (std::size_t k = 0; k < std::size(law_numbers); ++k) {
    const LawNumber& n = law_numbers[k];
    double* const number = n.in(law);
    if (entry.numbers[k] && !number)
      fail_in_file(path, line(n.key), "law '", name_of(law), "' of material '", entry.sourced.material.name,
                   "' has no ", n.key, " (", n.help, ")");
    if (number && n.required && !entry.numbers[k] && !complete)
      fail_in_file(path, begin, "missing key 'material.", n.key, "' of law '", name_of(law), "'");
    if (entry.numbers[k]) *number = *entry.numbers[k];
  }
  const auto* rough = std::get_if<RoughLaw>(&law);
  if (rough && !complete && (rough->density > 0) == (line("reflection") > 0))
    fail_in_file(path, begin, "law 'rough' of material '", entry.sourced.material.name,
                 "' needs either density with compression_speed, or reflection");
  auto* table = std::get_if<TableLaw>(&law);
  if (table && !complete) *table = entry.table, table->half_vector = entry.bistatic == "half_vector";
  for (const char* key : {"incidence_deg", "frequency_khz", "sigma_db", "bistatic"})
    if (line(key) > 0 && (!table || complete)) fail_in_file(path, line(key), key, " belongs to law = \"table\"");
  return law;
}

std::vector<std::string> names_of_laws() {
  std::vector<std::string> names;
  for (const SurfaceLaw& law : surface_laws()) names.emplace_back(name_of(law));
  return names;
}

}  // namespace

std::vector<Key> material_keys(MaterialEntry& entry) {
  Material& material = entry.sourced.material;
  std::vector<Key> keys = {
      {"material", "name", "", text(material.name), "name of the material", true},
      {"material", "law", "", word(entry.law, names_of_laws()), "scattering law; default: lambert"},
      {"material", "like", "", text(entry.like), "name of a material whose numbers are the defaults of this one"}};
  for (const MaterialNumber& n : material_numbers)
    keys.push_back({"material", n.key, n.in_decibels ? "dB" : n.unit, number_of(material, n), n.help, n.required});
  for (std::size_t k = 0; k < std::size(law_numbers); ++k)
    keys.push_back({"material", law_numbers[k].key, law_numbers[k].file_unit,
                    number_of(entry.numbers[k], law_numbers[k]), law_numbers[k].help});
  const NumberRule label{.least = 0, .most = std::numeric_limits<std::uint16_t>::max(), .whole = true},
      any{.infinite = true};
  keys.insert(
      keys.end(),
      {
          {"material", "incidence_deg", "deg", list(given(entry.table.incidence), {.least = 0, .most = 90}, in_degrees),
           "law table: angles of incidence, ascending from 0 to 75 or more, below 90"},
          {"material", "frequency_khz", "kHz", list(given(entry.table.frequency), positive, in_kilohertz),
           "law table: frequencies, ascending; default: the same strengths at all frequencies"},
          {"material", "sigma_db", "dB re 1/sr", list(given(entry.table.sigma_db)),
           "law table: backscattering strengths at all angles for the first frequency, then for the next"},
          {"material", "bistatic", "", word(entry.bistatic, {"separable", "half_vector"}),
           "law table: strength between two directions. separable: the geometric mean of both strengths; half_vector: "
           "the strength at the half vector, for lobes; default: separable"},
          {"material", "label", "", number(entry.sourced.label, label),
           "label of the material in the cloud; default: its position in the file"},
          {"material", "from", "", number(entry.interval.from, any),
           "first value of an interval of field values (included), in place of a label"},
          {"material", "to", "", number(entry.interval.to, any),
           "end of the interval (excluded); one of `from` and `to` may be omitted"},
          {"material", "status", "", text(entry.sourced.status), "origin of the values: sourced, derived, user, ..."},
          {"material", "source", "", text(entry.sourced.source), "source of the values"},
      });
  return keys;
}

void read_material(const std::string& path, const TomlValue& table, MaterialEntry& entry,
                   const std::function<Material(const std::string&)>& find_like,
                   const std::vector<std::string>& others) {
  const auto line = [&](const char* key) { return table.find(key) ? table.find(key)->line : 0; };
  if (const TomlValue* like = table.find("like"); like && like->kind == TomlValue::Kind::text)
    at_line(
        path, like->line, [&] { entry.sourced.material = find_like(like->text); }, "like: ");
  std::vector<Key> keys = material_keys(entry);
  const bool lambert = !line("like") && (!line("law") || table.find("law")->text == "lambert");
  for (Key& key : keys) key.required = key.required && (lambert || key.name != std::string("lambert_mu_db"));
  read_keys(path, table, keys, "material", others);
  Material& material = entry.sourced.material;
  material.law = law_of(path, entry, table.line, line);
  if (!lambert && line("lambert_mu_db") && material.law != SurfaceLaw{})
    fail_in_file(path, line("lambert_mu_db"), "lambert_mu_db of material '", material.name, "' has no use beside law '",
                 name_of(material.law), "'; leave it out");
  const std::string here = path + ":" + std::to_string(table.line);
  require_valid(material, here.c_str(), ErrorKind::content);
}

}  // namespace insonify
