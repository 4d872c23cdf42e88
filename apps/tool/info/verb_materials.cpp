// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "acoustics/surface_laws.hpp"
#include "core/error.hpp"
#include "run/parse_values.hpp"
#include "store/run_directory.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "tool/info/info.hpp"
#include "view/line_chart_internal.hpp"

namespace insonify::tool {
namespace {

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
  Listed all{built_in_materials(), load_materials(built_in_materials()).materials, {}};
  if (name.empty()) {
    all.files = list_materials();
    return all;
  }
  std::erase_if(all.table, [&](const SourcedMaterial& m) { return m.material.name != name; });
  if (all.table.empty()) all.files = {find_material_file(name)}, all.path = all.files[0].path;
  return all;
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
  nlohmann::ordered_json json = materials_json(all.table);
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
