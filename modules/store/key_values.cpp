// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "store/key_table.hpp"

namespace insonify {
namespace {

using Kind = TomlValue::Kind;

std::string text_of_number(double value) { return printed("%.10g", value); }

std::string rule_of(const NumberRule& rule) {
  const bool low = std::isfinite(rule.least), high = std::isfinite(rule.most);
  std::string text = rule.whole ? "a whole number" : "a number";
  if (low && high && !rule.above)
    text += " within " + text_of_number(rule.least) + " and " + text_of_number(rule.most);
  else if (low)
    text += (rule.above ? " > " : " at least ") + text_of_number(rule.least);
  if (high && (rule.above || !low)) text += (low ? " and at most " : " at most ") + text_of_number(rule.most);
  return text + (*rule.note ? std::string(" (") + rule.note + ")" : "");
}

bool obeys(const TomlValue& value, const NumberRule& rule) {
  const double x = value.number;
  if (!value.is_number() || !(rule.infinite || std::isfinite(x))) return false;
  if (rule.whole && x != std::floor(x)) return false;
  if (rule.least > -std::numeric_limits<double>::infinity() && !(rule.above ? x > rule.least : x >= rule.least))
    return false;
  return !(rule.most < std::numeric_limits<double>::infinity()) || x <= rule.most;
}

Form<double> number_form(const NumberRule& rule, const Scale& scale) {
  const auto read = [=](const TomlValue& value) {
    return obeys(value, rule) ? std::optional(scale.from_file(value.number)) : std::nullopt;
  };
  return {rule_of(rule), read, [=](double x) { return rule.whole ? printed("%.0f", x) : as_toml(scale.to_file(x)); }};
}

Form<std::string> word_form(const std::vector<std::string>& words) {
  const auto read = [=](const TomlValue& value) {
    const bool good =
        value.kind == Kind::text && (words.empty() || std::ranges::find(words, value.text) != words.end());
    return good ? std::optional(value.text) : std::nullopt;
  };
  const auto write = [](const std::string& word) { return as_toml(word); };
  return {words.empty() ? "text in quotes" : "one of " + joined(words), read, write};
}

template <typename T>
Form<std::vector<T>> list_form(const Form<T>& each, const ListRule& rule) {
  const auto read = [=](const TomlValue& value) -> std::optional<std::vector<T>> {
    const bool bare = rule.bare && value.kind != Kind::array;
    if (!bare && value.kind != Kind::array) return std::nullopt;
    std::vector<T> list;
    for (const TomlValue& item : bare ? std::vector{value} : value.items) {
      const std::optional<T> entry = each.read(item);
      if (!entry) return std::nullopt;
      list.push_back(*entry);
    }
    const bool good = list.size() >= rule.least && list.size() <= rule.most;
    return good ? std::optional(list) : std::nullopt;
  };
  const auto write = [=](const std::vector<T>& list) { return "[" + joined(list, ", ", each.write) + "]"; };
  return {*rule.text ? rule.text : "a list, each " + each.rule, read, write};
}

template <int n>
Form<Eigen::Vector<double, n>> vector_form(const std::string& rule, const Scale& scale) {
  const Form<std::vector<double>> numbers = list_form(number_form({}, scale), {.least = n, .most = n});
  const auto read = [=](const TomlValue& value) -> std::optional<Eigen::Vector<double, n>> {
    const std::optional<std::vector<double>> list = numbers.read(value);
    return list ? std::optional<Eigen::Vector<double, n>>(list->data()) : std::nullopt;
  };
  return {rule, read, [=](const auto& vector) { return numbers.write({vector.begin(), vector.end()}); }};
}

}  // namespace

double shortest_degrees(double angle) {
  const double straight = degrees(angle);
  double rounded = 0;
  for (int digits = 6; digits <= 17; ++digits)
    if (to_number(printed("%.*g", digits, straight), rounded) && radians(rounded) == angle) return rounded;
  // An angle that was computed in radians may be off by its last bit.
  for (const double towards : {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}) {
    double near = straight;
    for (int step = 0; step < 4; ++step)
      if (near = std::nextafter(near, towards); radians(near) == angle) return near;
  }
  return straight;
}

KeyValue number(const Member<double>& number, const NumberRule& rule, const Scale& scale) {
  return value_in(number, number_form(rule, scale));
}

KeyValue angle(const Member<double>& angle, const NumberRule& rule) { return number(angle, rule, in_degrees); }

KeyValue list(const Member<std::vector<double>>& numbers, const NumberRule& each, const Scale& scale,
              const ListRule& rule) {
  Form<std::vector<double>> form = list_form(number_form(each, scale), rule);
  if (rule.ascending)
    form.read = [read = form.read](const TomlValue& value) {
      const std::optional<std::vector<double>> list = read(value);
      return list && list->front() <= list->back() ? list : std::nullopt;
    };
  return value_in(numbers, form);
}

KeyValue vector(const Member<Eigen::Vector3d>& vector, const char* meaning, const Scale& scale) {
  return value_in(vector, vector_form<3>(std::string("three numbers: ") + meaning, scale));
}

KeyValue points(const Member<std::vector<Eigen::Vector3d>>& points) {
  return value_in(points, list_form(vector_form<3>("", as_it_is), {.least = 0, .text = "a list of points [x, y, z]"}));
}

KeyValue polygon(const Member<std::vector<Eigen::Vector2d>>& corners) {
  const ListRule rule{.least = 3, .text = "a list of three or more corners [x, y]"};
  return value_in(corners, list_form(vector_form<2>("", as_it_is), rule));
}

KeyValue flag(const Member<bool>& flag) {
  const auto read = [](const TomlValue& value) {
    return value.kind == Kind::boolean ? std::optional(value.number != 0) : std::nullopt;
  };
  return value_in<bool>(flag, {"true or false", read, [](bool on) { return on ? "true" : "false"; }});
}

KeyValue seed(const Member<std::uint64_t>& seed) {
  // Integers above 2^63 do not exist in TOML, and many readers are inexact above 2^53: accept such numbers as text.
  const auto read = [](const TomlValue& value) -> std::optional<std::uint64_t> {
    std::uint64_t number = 0;
    if (value.kind == Kind::text && to_number(value.text, number)) return number;
    if (value.kind != Kind::integer || value.number < 0 || value.number >= 0x1p53) return std::nullopt;
    return static_cast<std::uint64_t>(value.number);
  };
  const auto write = [](std::uint64_t number) {
    const std::string digits = std::to_string(number);
    return number < (std::uint64_t{1} << 53) ? digits : as_toml(digits);
  };
  return value_in<std::uint64_t>(seed, {"an integer from 0, in quotes from 2^53", read, write});
}

KeyValue text(const Member<std::string>& text, const char* rule, bool (*allowed)(const std::string&)) {
  Form<std::string> form = word_form({});
  form.rule = rule;
  form.read = [allowed](const TomlValue& value) {
    return value.kind == Kind::text && allowed(value.text) ? std::optional(value.text) : std::nullopt;
  };
  return value_in(text, form);
}

KeyValue path(const Member<std::string>& path) {
  KeyValue value = text(path);
  value.set = [path](const TomlValue& from, const std::string& file) {
    if (from.kind == Kind::text) path.set(path_named_in(file, from.text));
    return from.kind == Kind::text;
  };
  return value;
}

KeyValue texts(const Member<std::vector<std::string>>& texts, const std::vector<std::string>& words) {
  return value_in(texts, list_form(word_form(words), {.least = 0, .text = words.empty() ? "a list of texts" : ""}));
}

KeyValue meaning(MeaningOverride& meaning, const MeaningOption& item) {
  const auto set = [&meaning, item](const TomlValue& value, const std::string& path) {
    const std::vector<TomlValue> items = value.kind == Kind::array ? value.items : std::vector{value};
    if (!items.empty() && std::ranges::all_of(items, &TomlValue::is_number)) {
      std::vector<double> numbers;
      std::ranges::transform(items, std::back_inserter(numbers), &TomlValue::number);
      return item.take(numbers, meaning);
    }
    if (value.kind == Kind::text) try {
        item.parse(value.text, meaning);
      } catch (const Error& error) {
        if (path.empty()) throw;
        fail_in_file(path, value.line, error.what());
      }
    return value.kind == Kind::text;
  };
  return {"text in quotes", set, [&meaning, item] { return std::optional(as_toml(item.text(meaning))); }};
}

KeyValue list_of_tables() {
  const auto set = [](const TomlValue& value, const std::string&) {
    const bool tables =
        std::ranges::all_of(value.items, [](const TomlValue& item) { return item.kind == Kind::table; });
    return value.kind == Kind::array && !value.items.empty() && tables;
  };
  return {"a list of tables [[...]]", set, [] { return std::nullopt; }};
}

KeyValue word(const Member<std::string>& text, const std::vector<std::string>& words) {
  return value_in(text, word_form(words));
}

KeyValue then(KeyValue value, const std::function<void()>& action) {
  value.set = [set = value.set, action](const TomlValue& from, const std::string& path) {
    if (!set(from, path)) return false;
    action();
    return true;
  };
  return value;
}

KeyValue omitted_if(KeyValue value, const std::function<bool()>& condition) {
  value.text = [text = value.text, condition] { return condition() ? std::nullopt : text(); };
  return value;
}

}  // namespace insonify
