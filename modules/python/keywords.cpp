// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <ranges>

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

/// The keys by all names that they have.
std::map<std::string, const Key*> by_name(const Keywords& of) {
  std::map<std::string, const Key*> named;
  for (const Key& key : of.keys) {
    std::vector<std::string> names{shown_name(of, key)};
    if (std::ranges::count(of.keys, std::string_view(key.name), &Key::name) == 1) names.push_back(key.name);
    const std::string_view* end = find_named(si_units, key.unit);
    for (const std::string& name : names) {
      named[name] = &key;
      if (end && name.ends_with(*end)) named.try_emplace(name.substr(0, name.size() - end->size()), &key);
    }
  }
  return named;
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

/// Returns what a value may stand for: itself, a list of one, numbers as text ("x,y,z").
std::vector<TomlValue> meanings_of(const TomlValue& value) {
  std::vector<TomlValue> meanings{value};
  if (value.kind != Kind::array) meanings.push_back({.kind = Kind::array, .items = {value}});
  const std::vector<TomlValue> numbers = meanings.back().items;
  const auto text = [](const TomlValue& item) { return fmt::format("{}", item.number); };
  if (std::ranges::all_of(numbers, &TomlValue::is_number))
    meanings.push_back({.kind = Kind::text, .text = joined(numbers, ",", text)});
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
Keywords keywords(PingOptions& options, bool of_ping) {
  if (!of_ping) return {keys_of(simulator_settings(options)), "ping"};
  Keywords of{keys_of(all_settings(options)), "ping"};
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
    const Key& key = *found->second;
    const std::string full = (*key.section ? std::string(key.section) + "." : "") + key.name;
    if (!value.is_none()) set_key({key}, full, meanings_of(value_of(value, who + ": " + name)), who + ": ");
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
