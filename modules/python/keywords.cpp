// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <ranges>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "core/error.hpp"
#include "python/binding_internal.hpp"
#include "run/run_settings.hpp"
#include "store/environment_keys.hpp"
#include "store/nearest_word.hpp"
#include "store/sonar_keys.hpp"

namespace insonify::python {
namespace {

using Kind = TomlValue::Kind;

constexpr Named<std::string_view> si_units[] = {{"m", "_m"}, {"Hz", "_hz"}, {"s", "_s"}, {"m/s", "_m_s"}};

/// The name that the docs give a key.
std::string shown_name(const Keywords& of, const Key& key) {
  return (*key.section && key.section != of.main ? std::string(key.section) + "_" : "") + key.name;
}

/// All names of the keys, in the order of the keys, and what each names.
std::vector<std::pair<std::string, const Key*>> all_names(const Keywords& of) {
  std::vector<std::pair<std::string, const Key*>> all;
  const auto is_new = [&](const std::string& name) {
    return std::ranges::find(all, name, &std::pair<std::string, const Key*>::first) == all.end();
  };
  std::vector<std::pair<std::string, const Key*>> without_unit;
  for (const Key& key : of.keys) {
    std::vector<std::string> names{shown_name(of, key)};
    if (std::ranges::count(of.keys, std::string_view(key.name), &Key::name) == 1 && names.front() != key.name)
      names.push_back(key.name);
    const std::string_view* end = find_named(si_units, key.unit);
    for (const std::string& name : names) {
      all.emplace_back(name, &key);
      if (end && name.ends_with(*end)) without_unit.emplace_back(name.substr(0, name.size() - end->size()), &key);
    }
  }
  for (const auto& [name, key] : without_unit)
    if (is_new(name)) all.emplace_back(name, key);
  return all;
}

/// The keys by all names that they have.
std::map<std::string, const Key*> by_name(const Keywords& of) {
  const auto all = all_names(of);
  return {all.begin(), all.end()};
}

/// The name as Python can spell it.
std::string spelt(const std::string& name) { return name == "with" ? name + "_" : name; }

/// Words of the tool for which Python has others than those of the settings.
constexpr Named<const char*> words_of_python[] = {
    {"force", "force=True"},           {"no-picture", "picture=False"},
    {"range", "min_range, max_range"}, {"pose", "position, yaw, pitch, roll"},
    {"mount", "mounting_deg"},         {"threads", "threads"}};

/// The keyword for an option of the tool; empty if there is none.
std::string keyword_of_option(const std::string& option) {
  if (const char* const* word = find_named(words_of_python, option)) return *word;
  static const auto of_settings = [] {
    std::map<std::string, std::string> names;
    Run any;
    for (const RunSetting& setting : all_settings(any)) names[setting.option] = setting.key;
    return names;
  }();
  const auto known = of_settings.find("--" + option);
  return known == of_settings.end() ? "" : spelt(known->second);
}

}  // namespace

std::string in_keywords(const std::string& text) {
  static const std::regex option("--(set (sonar\\.)?([a-z]+\\.)?([a-z_]+)|[a-z][a-z-]*[a-z])(?![a-z-])");
  std::string result;
  auto from = text.cbegin();
  for (std::sregex_iterator found(text.begin(), text.end(), option), end; found != end; ++found) {
    const std::smatch& match = *found;
    std::string word = keyword_of_option(match[1]);
    if (match[4].matched) {
      std::string section = match[3];
      if (!section.empty()) section.back() = '_';
      word = (section == "water_" ? "" : section) + match[4].str();
    }
    result.append(from, match[0].first);
    result += word.empty() ? match[0].str() : word;
    from = match[0].second;
  }
  result.append(from, text.cend());
  if (const std::string_view own = "EditedScene::"; result.starts_with(own)) result.replace(0, own.size(), "Scene.");
  return result;
}

TomlValue value_of(const py::handle& value, const std::string& name) {
  if (PyBool_Check(value.ptr()) || std::string(Py_TYPE(value.ptr())->tp_name) == "numpy.bool_")
    return {.kind = Kind::boolean, .number = py::cast<bool>(value) ? 1.0 : 0.0};
  if (PyUnicode_Check(value.ptr()) || py::hasattr(value, "__fspath__"))
    return {.kind = Kind::text, .text = py::cast<std::string>(py::str(value))};
  if (PyList_Check(value.ptr()) || PyTuple_Check(value.ptr()) ||
      (py::isinstance<py::array>(value) && py::cast<py::array>(value).ndim() > 0)) {
    TomlValue items{.kind = Kind::array};
    for (const py::handle item : value) items.items.push_back(value_of(item, name));
    return items;
  }
  if (!PyNumber_Check(value.ptr()) || PyComplex_Check(value.ptr()))
    fail(ErrorKind::argument, name, " is a ", Py_TYPE(value.ptr())->tp_name, ", must be a number, a text or a list");
  const double x = py::cast<double>(py::float_(py::reinterpret_borrow<py::object>(value)));
  if (!PyIndex_Check(value.ptr())) return {.kind = Kind::number, .number = x};
  // Long integers are text, as in files.
  if (std::abs(x) < 0x1p53) return {.kind = Kind::integer, .number = x};
  return {.kind = Kind::text, .text = py::cast<std::string>(py::str(value))};
}

py::object object_of(const TomlValue& value) {
  switch (value.kind) {
    case TomlValue::Kind::boolean:
      return py::bool_(value.number != 0);
    case TomlValue::Kind::integer:
      return py::int_(static_cast<std::int64_t>(value.number));
    case TomlValue::Kind::number:
      return py::float_(value.number);
    case TomlValue::Kind::array:
      break;
    default:
      return py::str(value.text);
  }
  py::list items;
  for (const TomlValue& item : value.items) items.append(object_of(item));
  return items;
}

namespace {

/// Returns what a value may stand for: itself, or a list of one.
std::vector<TomlValue> meanings_of(const TomlValue& value) {
  std::vector<TomlValue> meanings{value};
  if (value.kind != Kind::array) meanings.push_back({.kind = Kind::array, .items = {value}});
  return meanings;
}

}  // namespace

Keywords keywords(Sonar& sonar) {
  Keywords of{sonar_keys(sonar.spec), ""};
  of.keys.push_back(mounting_key(sonar.file));
  return of;
}
Keywords keywords(Environment& environment) { return {environment_keys(environment), "water"}; }
Keywords keywords(SceneOptions& options) {
  const auto settings = scene_settings(options);
  return {keys_of({settings.begin() + 1, settings.end()}), "scene"};  // all but the path
}
Keywords keywords(Run& run, bool of_ping) {
  if (!of_ping) return {keys_of(simulator_settings(run)), "ping"};
  Keywords of{keys_of(all_settings(run)), "ping"};
  const std::vector<std::string> names{"seed", "keep", "contributors", "display",  "time",
                                       "ping", "draw", "velocity",     "turn_rate"};
  std::erase_if(of.keys, [&](const Key& key) { return std::ranges::find(names, key.name) == names.end(); });
  return of;
}

void set_keywords(const Keywords& of, const py::dict& given, const std::string& who) {
  const std::map<std::string, const Key*> named = by_name(of);
  for (const auto& [word, value] : given) {
    std::string name = py::cast<std::string>(word);
    if (name.ends_with("_")) name.pop_back();  // with_
    const auto found = named.find(name);
    if (found == named.end()) {
      const auto known = std::views::keys(named);
      fail(ErrorKind::argument, who, ": unknown keyword '", name, "'", did_you_mean(name, {known.begin(), known.end()}),
           "; its docs list all");
    }
    Key key = *found->second;
    key.section = "";  // no keyword has it
    if (!value.is_none()) set_key({key}, key.name, meanings_of(value_of(value, who + ": " + name)), who + ": ");
  }
}

const char* with_docs(const char* text, const Keywords& of) {
  static std::deque<std::string> kept;
  std::string& docs = kept.emplace_back(std::string(text) + "\n\nKeywords:\n");
  for (const Key& key : of.keys)
    docs += fmt::format("    {}{}: {}{}{}\n", shown_name(of, key), *key.unit ? fmt::format(" [{}]", key.unit) : "",
                        key.value.rule, key.help.empty() ? "" : "; ", key.help);
  return docs.c_str();
}

const char* signed_docs(const std::string& name, const std::string& fixed, const char* text, const Keywords& of) {
  std::string arguments = fixed;
  if (!of.keys.empty() && fixed.find('*') == fixed.npos) arguments += fixed.empty() ? "*" : ", *";
  std::set<std::string> given;
  std::istringstream words(fixed);
  for (std::string word; words >> word;) given.insert(word.substr(0, word.find_first_of("=,")));
  for (const auto& [word, key] : all_names(of))
    if (!given.contains(spelt(word))) arguments += ", " + spelt(word) + "=None";
  const std::string signature = name + "(" + arguments + ")\n--\n\n";
  static std::deque<std::string> kept;
  return kept.emplace_back(signature + (of.keys.empty() ? text : with_docs(text, of))).c_str();
}

Numbers numbers_of(const py::handle& value, const std::string& name, py::ssize_t columns, py::ssize_t rows) {
  const std::string wanted = ", must be finite numbers of shape (" + (rows < 0 ? "n" : std::to_string(rows)) +
                             (columns > 0 ? fmt::format(", {})", columns) : ",)");
  const auto array = py::array::ensure(value);
  if (!array) {
    PyErr_Clear();
    fail(ErrorKind::argument, name, " is a ", Py_TYPE(value.ptr())->tp_name, wanted);
  }
  const bool fits = array.ndim() == (columns > 0 ? 2 : 1) && (columns == 0 || array.shape(1) == columns) &&
                    (rows < 0 || array.shape(0) == rows);
  if (!fits || std::string("fiu").find(array.dtype().kind()) == std::string::npos)
    fail(ErrorKind::argument, name, " is an array of ", py::cast<std::string>(py::str(array.dtype())), " of shape ",
         py::cast<std::string>(py::str(array.attr("shape"))), wanted);
  Numbers numbers = Numbers::ensure(array);
  for (py::ssize_t i = 0; i < numbers.size(); ++i)
    if (const double x = numbers.data()[i]; !std::isfinite(x))
      fail(ErrorKind::argument, name, ": row ", columns > 0 ? i / columns : i, " has ", x, wanted);
  return numbers;
}

}  // namespace insonify::python
