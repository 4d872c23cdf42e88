// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "acoustics/surface_laws.hpp"
#include "core/units.hpp"
#include "store/sonar_file.hpp"
#include "tool/info/info.hpp"

namespace insonify::tool {

using nlohmann::ordered_json;

namespace {

double in_file(const Material& material, const MaterialNumber& number) {
  const double value = material.*number.member;
  return number.in_decibels ? std::round(1e4 * db_from_power(value)) / 1e4 : value;
}

/// Returns true if the material's law uses a number; only Lambert's law uses Lambert's coefficient.
bool counts(const Material& material, const MaterialNumber& number) {
  return number.member != &Material::lambert_mu || material.law == SurfaceLaw{};
}

}  // namespace

std::string built_in_materials() { return data_folder() + "/materials.toml"; }

ordered_json materials_json(const std::vector<SourcedMaterial>& materials) {
  ordered_json all = ordered_json::array();
  for (const SourcedMaterial& m : materials) {
    ordered_json row = {{"name", m.material.name}, {"label", m.label}};
    for (const MaterialNumber& number : material_numbers)
      if (counts(m.material, number)) row[number.key] = in_file(m.material, number);
    row["status"] = m.status, row["source"] = m.source;
    row["law"] = name_of(m.material.law);
    if (m.material.law != SurfaceLaw{}) row["law_numbers"] = law_to_text(m.material.law);
    all.push_back(row);
  }
  return all;
}

void print_materials(const std::vector<SourcedMaterial>& materials) {
  std::vector<MaterialNumber> shown;  // what some material says
  for (const MaterialNumber& number : material_numbers)
    if (number.required || std::any_of(materials.begin(), materials.end(), [&](const SourcedMaterial& m) {
          return m.material.*number.member != Material{}.*number.member;
        }))
      shown.push_back(number);
  fmt::print("{:<16} {:>5}", "name", "label");
  for (const MaterialNumber& number : shown) fmt::print("  {:>17}", number.key);
  fmt::print("  {:<8} {}\n", "status", "source");
  for (const SourcedMaterial& m : materials) {
    fmt::print("{:<16} {:>5}", m.material.name, m.label);
    for (const MaterialNumber& number : shown)
      fmt::print("  {:>17}", counts(m.material, number) ? fmt::format("{:.4g}", in_file(m.material, number)) : "-");
    fmt::print("  {:<8} {}\n", m.status, m.source);
  }
  for (const SourcedMaterial& m : materials)
    if (m.material.law != SurfaceLaw{}) fmt::print("{}: law {}\n", m.material.name, law_to_text(m.material.law));
  fmt::print(
      "\nlaw: Lambert, cross-section per area = mu cos^2 of the angle of incidence (E4); lambert_mu_db = "
      "10 log10(mu / "
      "(1/sr)), "
      "coherent_fraction of the intensity has no speckle (E53), relief_slope: rms slope of finer relief (E52)\n");
}

ordered_json material_json(const MaterialFile& file) {
  ordered_json numbers = ordered_json::array();
  for (const SourcedNumber& n : file.numbers)
    numbers.push_back({{"key", n.key}, {"value", n.value}, {"status", n.status}, {"source", n.source}});
  return {{"name", file.material.name},
          {"description", file.description},
          {"law", name_of(file.material.law)},
          {"path", file.path},
          {"numbers", numbers}};
}

void print_material_files(const std::vector<MaterialFile>& files, bool as_table) {
  if (files.empty()) return;
  if (as_table)
    fmt::print("\nwith laws of their own (docs/surfaces.md):\n\n{:<28} {:<12} {}\n", "name", "law", "description");
  for (const MaterialFile& file : files) {
    const Material& m = file.material;
    if (as_table) {
      fmt::print("{:<28} {:<12} {}\n", m.name, name_of(m.law), file.description);
      continue;
    }
    fmt::print("{}: {}, law {}\n\n", m.name, file.description, name_of(m.law));
    for (const SourcedNumber& n : file.numbers)
      fmt::print("  {:<22} {:>10}  {:<9} {}\n", n.key, n.value, n.status, n.source);
    for (const double frequency : {30e3, 100e3, 400e3, 900e3}) {
      fmt::print("\n  at {:3.0f} kHz, {} deg grazing:", frequency * 1e-3, "10 20 30 45 60 90");
      const auto surface = surface_of(m, frequency, material_sound_speed);
      for (const double deg : {10, 20, 30, 45, 60, 90}) {
        const double sine = std::sin(radians(deg));
        fmt::print(" {:6.1f}", db_from_power(surface->back(sine) * sine));
      }
      fmt::print(" dB");
      const std::string subject = fmt::format("material '{}': law {} ", m.name, name_of(m.law));
      for (const std::string& note : surface_notes({&m, 1}, frequency, material_sound_speed))
        fmt::print("\n    {}", note.substr(subject.size()));
    }
    fmt::print("\n");
  }
}

ordered_json shares_json(const std::vector<MaterialShare>& shares) {
  ordered_json all = ordered_json::array();
  for (const MaterialShare& share : shares) {
    ordered_json row = {{"name", share.name}, {"law", share.law}, {"points", share.points}, {"share", share.share}};
    if (share.area) row["area_m2"] = *share.area;
    all.push_back(row);
  }
  return all;
}

}  // namespace insonify::tool
