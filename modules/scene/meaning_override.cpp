// SPDX-License-Identifier: BSD-3-Clause
#include "scene/meaning_override.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"

namespace insonify {
namespace {

/// Returns the numbers of a list with commas. Throws Error(argument) that states the rule of the option.
std::vector<double> numbers_of(const char* option, const std::string& text, const char* rule) {
  std::vector<double> numbers;
  for (const std::string_view word : split_at(',', text)) {
    const std::optional<double> value = finite_number(trimmed(word));
    if (!value) fail(ErrorKind::argument, option, " = '", text, "' must be ", rule);
    numbers.push_back(*value);
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

/// Returns the classes of these numbers; nothing if one is not whole and from 0 to 255.
std::optional<PointClasses> classes_of(const std::vector<double>& numbers) {
  PointClasses classes;
  for (const double number : numbers) {
    if (number != std::floor(number) || number < 0 || number > 255) return std::nullopt;
    classes.set(static_cast<std::size_t>(number));
  }
  return classes;
}

PointClasses parse_classes(const std::string& text) {
  if (text == "all") return PointClasses().set();
  const char* const rule = "all, or whole numbers from 0 to 255 with commas between them, e.g. 2,9";
  const std::optional<PointClasses> classes = classes_of(numbers_of("--classes", text, rule));
  if (!classes) fail(ErrorKind::argument, "--classes = '", text, "' must be ", rule);
  return *classes;
}

/// Returns a number in the fewest digits that read back to the same bits.
std::string shortest_text(double number) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
}

std::string unit_text(double metres) {
  constexpr Named<double> units[] = {{"m", 1},    {"mm", 1e-3},   {"cm", 1e-2},
                                     {"km", 1e3}, {"ft", 0.3048}, {"us-ft", 1200.0 / 3937}};
  const std::string name = name_of(units, metres);
  return name.empty() ? shortest_text(metres) : name;
}

std::string classes_text(const PointClasses& classes) {
  if (classes.all()) return "all";
  std::vector<double> numbers;
  for (std::size_t i = 0; i < classes.size(); ++i)
    if (classes[i]) numbers.push_back(static_cast<double>(i));
  return joined(numbers, ",", shortest_text);
}

bool no_numbers(const std::vector<double>&, MeaningOverride&) { return false; }

constexpr MeaningOption meaning_rows[] = {
    {"unit", "--unit",
     "unit of the coordinates: m, mm, cm, km, ft, us-ft, or metres per unit; default: that of the file, else m",
     [](const MeaningOverride& m) { return m.unit ? unit_text(*m.unit) : ""; },
     [](const std::string& text, MeaningOverride& m) {
       m.unit = text.empty() ? std::nullopt : std::optional(parse_unit(text));
     },
     [](const std::vector<double>& numbers, MeaningOverride& m) {
       m.unit = numbers.front();
       return numbers.size() == 1 && std::isfinite(*m.unit) && *m.unit > 0;
     }},
    {"z", "--z", "sign of z: up, or down for depths; default: as the file says, else up",
     [](const MeaningOverride& m) { return std::string(m.z_down ? (*m.z_down ? "down" : "up") : ""); },
     [](const std::string& text, MeaningOverride& m) {
       m.z_down = text.empty() ? std::nullopt : std::optional(is_first("--z", text, "down", "up"));
     },
     no_numbers},
    {"up", "--up", "axis of the file that points up: y or z; default: y of glTF, else z",
     [](const MeaningOverride& m) { return std::string(m.y_up ? (*m.y_up ? "y" : "z") : ""); },
     [](const std::string& text, MeaningOverride& m) {
       m.y_up = text.empty() ? std::nullopt : std::optional(is_first("--up", text, "y", "z"));
     },
     no_numbers},
    {"band", "--band",
     "number or name of the band or variable of a raster that holds the heights; default: the one that is named "
     "as one, else 1",
     [](const MeaningOverride& m) { return m.band_number > 0 ? std::to_string(m.band_number) : m.band; },
     [](const std::string& text, MeaningOverride& m) { m.band = text, m.band_number = 0; },
     [](const std::vector<double>& numbers, MeaningOverride& m) {
       const double number = numbers.front();
       if (numbers.size() != 1 || number != std::floor(number) || !(number >= 1 && number < 1e6)) return false;
       m.band.clear(), m.band_number = static_cast<std::size_t>(number);
       return true;
     }},
    {"nodata", "--nodata",
     "heights that mark holes, as numbers with commas between them, or none; default: those of the file, and numbers "
     "such as -9999 that stand far from all others",
     [](const MeaningOverride& m) {
       return !m.no_data ? "" : m.no_data->empty() ? "none" : joined(*m.no_data, ",", shortest_text);
     },
     [](const std::string& text, MeaningOverride& m) {
       const char* const rule = "none, or numbers with commas between them, e.g. -9999";
       m.no_data.reset();
       if (!text.empty()) m.no_data = text == "none" ? std::vector<double>() : numbers_of("--nodata", text, rule);
     },
     [](const std::vector<double>& numbers, MeaningOverride& m) {
       m.no_data = numbers;
       return true;
     }},
    {"classes", "--classes",
     "classes of LAS points that are read, as numbers with commas between them, or all; default: all but noise (7 and "
     "18)",
     [](const MeaningOverride& m) { return m.classes ? classes_text(*m.classes) : ""; },
     [](const std::string& text, MeaningOverride& m) {
       m.classes = text.empty() ? std::nullopt : std::optional(parse_classes(text));
     },
     [](const std::vector<double>& numbers, MeaningOverride& m) {
       m.classes = classes_of(numbers);
       return m.classes.has_value();
     }},
};

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

std::span<const MeaningOption> meaning_options() { return meaning_rows; }

}  // namespace insonify
