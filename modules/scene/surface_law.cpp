// SPDX-License-Identifier: BSD-3-Clause
#include "scene/surface_law.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <utility>

namespace insonify {
namespace {

constexpr double least_last_incidence = radians(75);
constexpr std::pair<const char*, std::vector<double> TableLaw::*> columns[] = {
    {"incidence", &TableLaw::incidence}, {"frequency", &TableLaw::frequency}, {"sigma_db", &TableLaw::sigma_db}};

template <typename... Parts>
std::string message(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

bool ascends(const std::vector<double>& v) {
  const auto not_above = [](double a, double b) { return !(a < b); };
  return std::adjacent_find(v.begin(), v.end(), not_above) == v.end() &&
         std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}

std::string problem_of(const TableLaw& t) {
  if (t.incidence.size() < 2) return message("incidence has ", t.incidence.size(), " angles, must have 2 or more");
  if (!ascends(t.incidence) || t.incidence.front() != 0)
    return "incidence must ascend from 0 without gaps or repetitions";
  if (t.incidence.back() < least_last_incidence - 1e-9 || t.incidence.back() >= pi / 2)
    return message("incidence ends at ", degrees(t.incidence.back()), " deg, must end within 75 and 90 (excluded)");
  if (!ascends(t.frequency) || (!t.frequency.empty() && !(t.frequency.front() > 0)))
    return "frequency must ascend and be > 0";
  const std::size_t rows = std::max<std::size_t>(1, t.frequency.size());
  if (t.sigma_db.size() != rows * t.incidence.size())
    return message("sigma_db has ", t.sigma_db.size(), " numbers, must have ", rows * t.incidence.size(),
                   ": one for each angle and frequency");
  for (const double x : t.sigma_db)
    if (!std::isfinite(x)) return message("sigma_db = ", x, " dB, must be finite");
  return {};
}

/// Shortest text that reads back as the same double.
std::string exact(double value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof(text), value).ptr);
}

bool read_numbers(std::string_view text, std::vector<double>& numbers) {
  while (!text.empty()) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), numbers.emplace_back());
    if (error != std::errc()) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (text.empty()) break;
    if (text.front() != ',') return false;
    text.remove_prefix(1);
  }
  return true;
}

bool set(SurfaceLaw& law, std::string_view name, std::string_view text) {
  std::vector<double> values;
  if (!read_numbers(text, values)) return false;
  if (auto* table = std::get_if<TableLaw>(&law)) {
    for (const auto& [column, member] : columns)
      if (name == column) return table->*member = values, true;
    if (name == "half_vector" && values.size() == 1) return table->half_vector = values[0] != 0, true;
  }
  for (const LawNumber& n : law_numbers)
    if (double* const number = n.in(law); number && name == n.name && values.size() == 1)
      return *number = values[0], true;
  return false;
}

}  // namespace

const char* name_of(const SurfaceLaw& law) { return surface_law_names[law.index()]; }

std::optional<SurfaceLaw> law_named(std::string_view name) {
  const SurfaceLaw laws[] = {LambertLaw{}, SeabedLaw{}, SmallSlopeLaw{}, RoughLaw{}, TableLaw{}};
  for (const SurfaceLaw& law : laws)
    if (name == name_of(law)) return law;
  return {};
}

bool has_own_slopes(const SurfaceLaw& law) {
  return !std::holds_alternative<LambertLaw>(law) && !std::holds_alternative<TableLaw>(law);
}

std::string problem_of(const SurfaceLaw& law) {
  if (const auto* table = std::get_if<TableLaw>(&law)) return problem_of(*table);
  SurfaceLaw copy = law;
  for (const LawNumber& n : law_numbers) {
    const double* const number = n.in(copy);
    if (!number ||
        (std::isfinite(*number) && *number >= n.least && *number <= n.most && !(n.above && *number <= n.least)))
      continue;
    return message(n.name, " = ", *number, *n.unit ? " " : "", n.unit, ", must be within ", n.least,
                   n.above ? " (excluded) and " : " and ", n.most, " (", n.help, ")");
  }
  const auto* rough = std::get_if<RoughLaw>(&law);
  if (rough && rough->density > 0 && !(rough->compression_speed > 0))
    return message("compression_speed = ", rough->compression_speed, " m/s, must be > 0 beside a density");
  if (rough && rough->density > 0 && rough->shear_speed >= rough->compression_speed)
    return message("shear_speed = ", rough->shear_speed,
                   " m/s, must be below compression_speed = ", rough->compression_speed, " m/s");
  return {};
}

std::string law_to_text(const SurfaceLaw& law) {
  std::string text = name_of(law);
  if (const auto* table = std::get_if<TableLaw>(&law)) {
    for (const auto& [name, member] : columns) {
      text += std::string(" ") + name + "=";
      for (const double& x : table->*member) text += (&x == (table->*member).data() ? "" : ",") + exact(x);
    }
    return text + (table->half_vector ? " half_vector=1" : "");
  }
  SurfaceLaw copy = law;
  for (const LawNumber& n : law_numbers)
    if (const double* const number = n.in(copy)) text += std::string(" ") + n.name + "=" + exact(*number);
  return text;
}

std::optional<SurfaceLaw> law_from_text(std::string_view text) {
  std::istringstream words{std::string(text)};
  std::string word;
  words >> word;
  std::optional<SurfaceLaw> law = law_named(word);
  while (law && words >> word) {
    const std::size_t at = word.find('=');
    if (at == std::string::npos ||
        !set(*law, std::string_view(word).substr(0, at), std::string_view(word).substr(at + 1)))
      return {};
  }
  return law;
}

}  // namespace insonify
