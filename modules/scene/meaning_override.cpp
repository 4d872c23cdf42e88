// SPDX-License-Identifier: BSD-3-Clause
#include "scene/meaning_override.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"

namespace insonify {
namespace {

/// Returns the numbers of a list with commas. Throws Error(argument) that states the rule of the option.
std::vector<double> numbers_of(const char* option, const std::string& text, const char* rule) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::optional<double> value = finite_number(trimmed(std::string_view(text).substr(begin, end - begin)));
    if (!value) fail(ErrorKind::argument, option, " = '", text, "' must be ", rule);
    numbers.push_back(*value);
    begin = end + 1;
  }
  return numbers;
}

double parse_unit(const std::string& text) {
  if (const std::optional<double> known = unit_named(text)) return *known;
  const std::optional<double> value = finite_number(text);
  if (!value || *value <= 0)
    fail(ErrorKind::argument, "--unit = '", text,
         "' must be m, mm, cm, km, ft, us-ft, or metres per unit as a number > 0");
  return *value;
}

/// Returns true if `text` is the first of two words. Throws Error(argument) if it is neither.
bool is_first(const char* option, const std::string& text, const char* first, const char* second) {
  if (text != first && text != second)
    fail(ErrorKind::argument, option, " = '", text, "' must be ", first, " or ", second);
  return text == first;
}

PointClasses parse_classes(const std::string& text) {
  if (text == "all") return PointClasses().set();
  const char* const rule = "all, or whole numbers from 0 to 255 with commas between them, e.g. 2,9";
  PointClasses classes;
  for (const double number : numbers_of("--classes", text, rule)) {
    if (number != std::floor(number) || number < 0 || number > 255)
      fail(ErrorKind::argument, "--classes = '", text, "' must be ", rule);
    classes.set(static_cast<std::size_t>(number));
  }
  return classes;
}

}  // namespace

std::optional<double> unit_named(std::string_view name) {
  constexpr double ft = 0.3048, us = 1200.0 / 3937;
  constexpr Named<double> units[] = {{"m", 1},
                                     {"metre", 1},
                                     {"meter", 1},
                                     {"mm", 1e-3},
                                     {"millimetre", 1e-3},
                                     {"millimeter", 1e-3},
                                     {"cm", 1e-2},
                                     {"centimetre", 1e-2},
                                     {"centimeter", 1e-2},
                                     {"km", 1e3},
                                     {"kilometre", 1e3},
                                     {"kilometer", 1e3},
                                     {"ft", ft},
                                     {"foot", ft},
                                     {"feet", ft},
                                     {"international foot", ft},
                                     {"us ft", us},
                                     {"us foot", us},
                                     {"us feet", us},
                                     {"us survey foot", us},
                                     {"us survey feet", us},
                                     {"usft", us},
                                     {"ftus", us},
                                     {"foot us", us},
                                     {"fathom", 6 * ft}};
  std::string plain = lower_case(std::string(name));
  std::replace_if(
      plain.begin(), plain.end(), [](char c) { return c == '_' || c == '-'; }, ' ');
  if (plain.size() > 4 && plain.back() == 's') plain.pop_back();
  const double* const known = find_named(units, plain);
  return known ? std::optional(*known) : std::nullopt;
}

MeaningOverride parse_meaning(const MeaningText& text) {
  MeaningOverride requested;
  if (!text.unit.empty()) requested.unit = parse_unit(text.unit);
  if (!text.z.empty()) requested.z_down = is_first("--z", text.z, "down", "up");
  if (!text.up.empty()) requested.y_up = is_first("--up", text.up, "y", "z");
  requested.band = text.band;
  if (text.no_data == "none")
    requested.no_data.emplace();
  else if (!text.no_data.empty())
    requested.no_data = numbers_of("--nodata", text.no_data, "none, or numbers with commas between them, e.g. -9999");
  if (!text.classes.empty()) requested.classes = parse_classes(text.classes);
  return requested;
}

}  // namespace insonify
