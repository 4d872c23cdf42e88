// SPDX-License-Identifier: BSD-3-Clause
#include "tool/info/material_list.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "store/sonar_file.hpp"

namespace insonify::tool {

using nlohmann::ordered_json;

namespace {

double in_file(const Material& material, const MaterialNumber& number) {
  const double value = material.*number.member;
  return number.in_decibels ? std::round(1e4 * db_from_power(value)) / 1e4 : value;
}

}  // namespace

std::string built_in_materials() { return data_folder() + "/materials.toml"; }

ordered_json materials_json(const std::vector<SourcedMaterial>& materials) {
  ordered_json all = ordered_json::array();
  for (const SourcedMaterial& m : materials) {
    ordered_json row = {{"name", m.material.name}, {"label", m.label}};
    for (const MaterialNumber& number : material_numbers) row[number.key] = in_file(m.material, number);
    row["status"] = m.status, row["source"] = m.source;
    all.push_back(row);
  }
  return all;
}

void print_materials(const std::vector<SourcedMaterial>& materials) {
  fmt::print("{:<16} {:>5}", "name", "label");
  for (const MaterialNumber& number : material_numbers) fmt::print("  {:>17}", number.key);
  fmt::print("  {:<8} {}\n", "status", "source");
  for (const SourcedMaterial& m : materials) {
    fmt::print("{:<16} {:>5}", m.material.name, m.label);
    for (const MaterialNumber& number : material_numbers) fmt::print("  {:>17.4g}", in_file(m.material, number));
    fmt::print("  {:<8} {}\n", m.status, m.source);
  }
  fmt::print(
      "\nlaw: Lambert, cross-section per area = mu cos^2 of the angle of incidence (E4); lambert_mu_db = 10 log10(mu / "
      "(1/sr)), "
      "coherent_fraction of the intensity has no speckle (E53), relief_slope: rms slope of finer relief (E52)\n");
}

ordered_json shares_json(const std::vector<MaterialShare>& shares) {
  ordered_json all = ordered_json::array();
  for (const MaterialShare& share : shares) {
    ordered_json row = {{"name", share.name}, {"points", share.points}, {"share", share.share}};
    if (share.area) row["area_m2"] = *share.area;
    all.push_back(row);
  }
  return all;
}

}  // namespace insonify::tool
