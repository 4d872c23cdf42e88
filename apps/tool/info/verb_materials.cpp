// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "acoustics/surface_laws.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "run/parse_values.hpp"
#include "run_scenes/run_folder.hpp"
#include "store/material_library.hpp"
#include "store/materials_file.hpp"
#include "store/run_directory.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "view/line_chart_internal.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

/// Sound speed [m/s] of the strengths that are listed and drawn.
constexpr double material_sound_speed = 1500;

struct MaterialsOptions {
  CommonOptions common;
  std::string name;
  bool toml = false;
  std::string output;
  std::string frequencies = "30,100,400";
  bool force = false;
};

void add_options(OptionList list, MaterialsOptions& o) {
  list.add("NAME", &o.name, "name of a material, or a .toml file of materials");
  list.add("--toml", &o.toml, "print the file, as a start for one of your own");
  list.add("-o,--output", &o.output, "picture that is written, .png: backscattering strength against grazing angle");
  list.add("--khz", &o.frequencies, "[kHz] frequencies of the picture");
  list.add("--force", &o.force, "replace an existing picture");
  add_common(list, o.common);
}

/// The materials that a name stands for: a file of them, one of Lambert's table, one of data/materials; or all.
struct Listed {
  std::string path;
  std::vector<SourcedMaterial> table;
  std::vector<MaterialFile> files;
};

Listed listed(const std::string& name) {
  if (std::filesystem::path(name).extension() == ".toml") return {name, load_materials(name).materials, {}};
  const std::string built_in = path_of_materials("");
  Listed all{built_in, load_materials(built_in).materials, {}};
  if (name.empty()) {
    all.files = list_materials();
    return all;
  }
  std::erase_if(all.table, [&](const SourcedMaterial& m) { return m.material.name != name; });
  if (all.table.empty()) all.files = {find_material_file(name)}, all.path = all.files[0].path;
  return all;
}

double in_file(const Material& material, const MaterialNumber& number) {
  const double value = material.*number.member;
  return number.in_decibels ? std::round(1e4 * db_from_power(value)) / 1e4 : value;
}

/// Returns true if the material's law uses a number; only Lambert's law uses Lambert's coefficient.
bool counts(const Material& material, const MaterialNumber& number) {
  return number.member != &Material::lambert_mu || material.law == SurfaceLaw{};
}

/// A list of name, label, the numbers under the keys of material files, status and source.
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

/// Prints a table of them, and the law that the numbers belong to.
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
      "\nlaw: Lambert, cross-section per area = mu cos^2 of the angle of incidence (E4); lambert_mu_db = 10 log10(mu / "
      "(1/sr)), coherent_fraction of the intensity has no speckle (E53), relief_slope: rms slope of finer relief "
      "(E52)\n");
}

/// A material with a law of its own: name, description, law, numbers with status and source.
ordered_json material_json(const MaterialFile& file) {
  return {{"name", file.material.name},
          {"description", file.description},
          {"law", name_of(file.material.law)},
          {"path", file.path},
          {"numbers", numbers_json(file.numbers)}};
}

/// Prints such materials: as a table, or each with its numbers and what is known of its law.
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

/// One line for each material and frequency.
void draw(const MaterialsOptions& o, const std::vector<Material>& materials) {
  const auto count = static_cast<std::size_t>(1 + std::count(o.frequencies.begin(), o.frequencies.end(), ','));
  const std::vector<double> khz = parse_numbers("--khz", o.frequencies, count, "frequencies in kHz, e.g. 100,400");
  LineChart chart;
  chart.title = "Backscattering strength at 1500 m/s";
  chart.x_title = "grazing angle [deg]", chart.y_title = "10 log10 sigma [dB re 1/sr]";
  chart.low_x = 0, chart.high_x = 90, chart.low_y = -60, chart.high_y = 15;
  for (const Material& m : materials)
    for (const double f : khz) {
      const auto surface = surface_of(m, 1e3 * f, material_sound_speed);
      ChartLine line;
      for (double deg = 1; deg <= 90; deg += 0.5) {
        const double sine = std::sin(radians(deg)), db = db_from_power(surface->back(sine) * sine);
        if (db < chart.low_y) continue;
        line.x.push_back(deg), line.y.push_back(db);
      }
      line.name = fmt::format("{}{:g} kHz", materials.size() > 1 ? m.name + " " : "", f);
      if (materials.size() == 1) chart.title = m.name + ": backscattering strength at 1500 m/s";
      const bool same = m.law == SurfaceLaw{};
      if (same) line.name = m.name;
      chart.lines.push_back(line);
      if (same) break;
    }
  PictureOptions picture;
  picture.width = 1100, picture.height = 800;
  draw_line_chart(chart, picture, "materials", o.output);
}

void materials(const MaterialsOptions& o) {
  const Listed all = listed(o.name);
  if (o.toml) {
    std::fputs(read_text_file(all.path).c_str(), stdout);
    return;
  }
  if (!o.output.empty()) {
    require_free_file(o.output, o.force, {});
    if (o.name.empty())
      fail(ErrorKind::argument, "-o needs the name of a material, e.g. insonify materials medium-sand -o sand.png");
    std::vector<Material> drawn;
    for (const SourcedMaterial& m : all.table) drawn.push_back(m.material);
    for (const MaterialFile& m : all.files) drawn.push_back(m.material);
    draw(o, drawn);
  }
  ordered_json json = materials_json(all.table);
  for (const MaterialFile& file : all.files) json.push_back(material_json(file));
  print_result(o.common, json, [&] {
    if (!all.table.empty()) print_materials(all.table);
    print_material_files(all.files, o.name.empty());
  });
}

}  // namespace

Verb materials_verb() {
  return make_verb<MaterialsOptions>(
      "materials", "the named materials, with their law, numbers and sources",
      {"insonify materials", "insonify materials medium-sand -o sand.png", "insonify materials sand --json",
       "insonify materials --toml > my-materials.toml",
       "insonify ping reef.pcd --material medium-sand --sonar p900-45 --pose=-1,4,-2.2,0,15,0 -o out"},
      add_options, materials);
}

}  // namespace insonify::tool
