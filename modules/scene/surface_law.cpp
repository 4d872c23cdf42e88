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

/// TR 9407 for its own range: 3 dB for sand and silt, 10 dB for gravel and rock. Beyond, to 400 kHz, within 5 dB of a
/// later model for sand and finer sediments at grazing angles from 20 degrees on, 6 to 19 dB for coarser ones.
double error_beyond(const Sediment& bed, double frequency) {
  constexpr double sandy_gravel = 1.3;  // speed ratio that parts sand from gravel
  return bed.speed_ratio < sandy_gravel && frequency <= 400e3 ? 5 : bed.speed_ratio < sandy_gravel ? 10 : 19;
}

/// Returns the shortest text that reads back as the same double.
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

LawValidity Sediment::validity(double frequency) const {
  return {10e3, 100e3, "TR 9407", error_beyond(*this, frequency)};
}

LawValidity SmallSlopeLaw::validity(double frequency) const {
  return {10e3, 300e3, "the sediment's numbers", error_beyond(*this, frequency)};
}

std::string RoughLaw::problem() const {
  if (density > 0 && !(compression_speed > 0))
    return message("compression_speed = ", compression_speed, " m/s, must be > 0 beside a density");
  if (density > 0 && shear_speed >= compression_speed)
    return message("shear_speed = ", shear_speed, " m/s, must be below compression_speed = ", compression_speed,
                   " m/s");
  return {};
}

std::string TableLaw::problem() const {
  if (incidence.size() < 2) return message("incidence has ", incidence.size(), " angles, must have 2 or more");
  if (!ascends(incidence) || incidence.front() != 0) return "incidence must ascend from 0 without gaps or repetitions";
  if (incidence.back() < least_last_incidence - 1e-9 || incidence.back() >= pi / 2)
    return message("incidence ends at ", degrees(incidence.back()), " deg, must end within 75 and 90 (excluded)");
  if (!ascends(frequency) || (!frequency.empty() && !(frequency.front() > 0)))
    return "frequency must ascend and be > 0";
  const std::size_t rows = std::max<std::size_t>(1, frequency.size());
  if (sigma_db.size() != rows * incidence.size())
    return message("sigma_db has ", sigma_db.size(), " numbers, must have ", rows * incidence.size(),
                   ": one for each angle and frequency");
  for (const double x : sigma_db)
    if (!std::isfinite(x)) return message("sigma_db = ", x, " dB, must be finite");
  return {};
}

LawValidity TableLaw::validity(double) const {
  if (frequency.empty()) return {};
  return {frequency.front(), frequency.back(), "its table", 10};
}

std::vector<SurfaceLaw> surface_laws() {
  return []<std::size_t... k>(std::index_sequence<k...>) {
    return std::vector<SurfaceLaw>{SurfaceLaw(std::in_place_index<k>)...};
  }
  (std::make_index_sequence<std::variant_size_v<SurfaceLaw>>());
}

std::optional<SurfaceLaw> law_named(std::string_view name) {
  for (const SurfaceLaw& law : surface_laws())
    if (name == name_of(law)) return law;
  return {};
}

LawValidity validity_of(const SurfaceLaw& law, double frequency) {
  return std::visit(
      [&](const auto& l) {
        if constexpr (requires { l.validity(frequency); })
          return l.validity(frequency);
        else
          return LawValidity{};
      },
      law);
}

std::vector<SurfaceLaw> laws_alike(const SurfaceLaw& law) {
  std::vector<SurfaceLaw> alike = {law};
  const auto sediment_in = [](auto& l) -> Sediment* {
    if constexpr (std::is_base_of_v<Sediment, std::remove_reference_t<decltype(l)>>)
      return &l;
    else
      return nullptr;
  };
  SurfaceLaw given = law;
  const Sediment* const bed = std::visit(sediment_in, given);
  for (SurfaceLaw& other : surface_laws())
    if (Sediment* const sediment = std::visit(sediment_in, other); bed && sediment && other.index() != law.index()) {
      *sediment = *bed;
      alike.push_back(other);
    }
  return alike;
}

std::string problem_of(const SurfaceLaw& law) {
  SurfaceLaw copy = law;
  for (const LawNumber& n : law_numbers) {
    const double* const number = n.in(copy);
    if (!number ||
        (std::isfinite(*number) && *number >= n.least && *number <= n.most && !(n.above && *number <= n.least)))
      continue;
    return message(n.name, " = ", *number, *n.unit ? " " : "", n.unit, ", must be within ", n.least,
                   n.above ? " (excluded) and " : " and ", n.most, " (", n.help, ")");
  }
  return std::visit(
      [](const auto& l) -> std::string {
        if constexpr (requires { l.problem(); })
          return l.problem();
        else
          return {};
      },
      law);
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
