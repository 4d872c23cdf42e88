// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "store/key_table_internal.hpp"

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

bool is_list(const TomlValue& value, const std::function<bool(const TomlValue&)>& of) {
  return value.kind == Kind::array && std::all_of(value.items.begin(), value.items.end(), of);
}

bool is_vector(const TomlValue& value) {
  return value.items.size() == 3 && is_list(value, [](const TomlValue& item) { return obeys(item, {}); });
}

Eigen::Vector3d vector_of(const TomlValue& value, const Scale& scale) {
  Eigen::Vector3d vector;
  for (int i = 0; i < 3; ++i) vector[i] = scale.from_file(value.items[static_cast<std::size_t>(i)].number);
  return vector;
}

std::string text_of_vector(const Eigen::Vector3d& vector, const Scale& scale) {
  return as_toml(std::vector{scale.to_file(vector[0]), scale.to_file(vector[1]), scale.to_file(vector[2])});
}

bool is_one_of(const TomlValue& value, const std::vector<std::string>& words) {
  return value.kind == Kind::text && (words.empty() || std::ranges::find(words, value.text) != words.end());
}

}  // namespace

double shortest_degrees(double angle) {
  const double straight = degrees(angle);
  for (int digits = 6; digits <= 17; ++digits) {
    std::array<char, 40> text{};
    const auto end = std::to_chars(text.begin(), text.end(), straight, std::chars_format::general, digits).ptr;
    double rounded = 0;
    std::from_chars(text.begin(), end, rounded);
    if (radians(rounded) == angle) return rounded;
  }
  // An angle that was computed in radians may be off by its last bit.
  for (const double towards : {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}) {
    double near = straight;
    for (int step = 0; step < 4; ++step)
      if (near = std::nextafter(near, towards); radians(near) == angle) return near;
  }
  return straight;
}

KeyValue number(const Number& number, const NumberRule& rule, const Scale& scale) {
  const auto set = [=](const TomlValue& value, const std::string&) {
    if (!obeys(value, rule)) return false;
    number.set(scale.from_file(value.number));
    return true;
  };
  const auto text = [=]() -> std::optional<std::string> {
    const std::optional<double> x = number.get();
    if (!x) return std::nullopt;
    return rule.whole ? printed("%.0f", *x) : as_toml(scale.to_file(*x));
  };
  return {rule_of(rule), set, text};
}

KeyValue list(std::vector<double>& numbers, const NumberRule& rule, const Scale& scale) {
  const auto set = [&numbers, rule, scale](const TomlValue& value, const std::string&) {
    if (value.items.empty() || !is_list(value, [&](const TomlValue& item) { return obeys(item, rule); })) return false;
    numbers.clear();
    for (const TomlValue& item : value.items) numbers.push_back(scale.from_file(item.number));
    return true;
  };
  const auto text = [&numbers, scale]() -> std::optional<std::string> {
    std::vector<double> written;
    for (const double x : numbers) written.push_back(scale.to_file(x));
    return written.empty() ? std::nullopt : std::optional(as_toml(written));
  };
  return {"a list, each " + rule_of(rule), set, text};
}

KeyValue vector(Eigen::Vector3d& vector, const char* meaning, const Scale& scale) {
  const auto set = [&vector, scale](const TomlValue& value, const std::string&) {
    if (is_vector(value)) vector = vector_of(value, scale);
    return is_vector(value);
  };
  return {std::string("three numbers: ") + meaning, set, [&vector, scale] { return text_of_vector(vector, scale); }};
}

KeyValue points(std::vector<Eigen::Vector3d>& points) {
  const auto set = [&points](const TomlValue& value, const std::string&) {
    if (!is_list(value, is_vector)) return false;
    points.clear();
    for (const TomlValue& item : value.items) points.push_back(vector_of(item, as_it_is));
    return true;
  };
  const auto text = [&points]() -> std::optional<std::string> {
    if (points.empty()) return std::nullopt;
    return "[" + joined(points, ", ", [](const Eigen::Vector3d& p) { return text_of_vector(p, as_it_is); }) + "]";
  };
  return {"a list of points [x, y, z]", set, text};
}

KeyValue flag(bool& flag) {
  const auto set = [&flag](const TomlValue& value, const std::string&) {
    if (value.kind == Kind::boolean) flag = value.number != 0;
    return value.kind == Kind::boolean;
  };
  return {"true or false", set, [&flag] { return flag ? "true" : "false"; }};
}

KeyValue seed(std::uint64_t& seed) {
  const auto set = [&seed](const TomlValue& value, const std::string&) {
    // TOML has no integers from 2^63 on, and its readers no exact ones from 2^53 on: those are text.
    const bool whole = value.kind == Kind::integer && value.number >= 0 && value.number < 0x1p53;
    if (whole) seed = static_cast<std::uint64_t>(value.number);
    return whole || (value.kind == Kind::text && to_number(value.text, seed));
  };
  const auto text = [&seed] {
    const std::string digits = std::to_string(seed);
    return seed < (std::uint64_t{1} << 53) ? digits : as_toml(digits);
  };
  return {"an integer from 0, in quotes from 2^53", set, text};
}

KeyValue text(std::string& text, const char* rule, bool (*allowed)(const std::string&)) {
  const auto set = [&text, allowed](const TomlValue& value, const std::string&) {
    if (value.kind != Kind::text || !allowed(value.text)) return false;
    text = value.text;
    return true;
  };
  return {rule, set, [&text] { return as_toml(text); }};
}

KeyValue path(std::string& path) {
  KeyValue value = text(path);
  value.set = [set = value.set, &path](const TomlValue& from, const std::string& file) {
    if (!set(from, file)) return false;
    path = path_named_in(file, path);
    return true;
  };
  return value;
}

KeyValue texts(std::vector<std::string>& texts, const std::vector<std::string>& words) {
  const auto set = [&texts, words](const TomlValue& value, const std::string&) {
    if (!is_list(value, [&](const TomlValue& item) { return is_one_of(item, words); })) return false;
    texts.clear();
    for (const TomlValue& item : value.items) texts.push_back(item.text);
    return true;
  };
  const auto text = [&texts] {
    return "[" + joined(texts, ", ", [](const std::string& word) { return as_toml(word); }) + "]";
  };
  return {words.empty() ? "a list of texts" : "a list, each one of " + joined(words), set, text};
}

KeyValue list_of_tables() {
  const auto set = [](const TomlValue& value, const std::string&) {
    return !value.items.empty() && is_list(value, [](const TomlValue& item) { return item.kind == Kind::table; });
  };
  return {"a list of tables [[...]]", set, [] { return std::nullopt; }};
}

KeyValue word(std::string& text, const std::vector<std::string>& words) {
  const auto set = [&text, words](const TomlValue& value, const std::string&) {
    if (is_one_of(value, words)) text = value.text;
    return is_one_of(value, words);
  };
  return {words.empty() ? "text in quotes" : "one of " + joined(words), set, [&text] { return as_toml(text); }};
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
