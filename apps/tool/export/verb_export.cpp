// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "returns/looks.hpp"
#include "returns/quantise.hpp"
#include "run/run_checks.hpp"
#include "scene_io/load_scene.hpp"
#include "store/run_directory.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "tool/export/export_product.hpp"
#include "tool/export/raster_plane.hpp"
#include "tool/run/record_file.hpp"
#include "tool/run/run_pings.hpp"
#include "view/save_vtk.hpp"

namespace insonify::tool {
namespace {

struct ExportOptions {
  CommonOptions common;
  ProductOptions product;
};

void add_options(OptionList list, ExportOptions& o) {
  ProductOptions& p = o.product;
  list.add("RUN", &p.run, "run directory, survey or cube.h5", {.required = true});
  list.add("-o,--output", &p.output, "file that is written; for vtk, png and neusis: folder that is made",
           {.required = true});
  list.add(
      "--to", &p.to,
      "format. vtk: grids and returns for ParaView. Soundings of the bottom: gsf (Generic Sensor Format 3.11), las "
      "(LAS 1.4 in UTM), geotiff (a grid in UTM or another projected system) or csv (a table). mcap: images, points "
      "and poses as messages of ROS 2. png: bare pictures. xtf: the samples of side-scans and scanning heads. neusis: "
      "images with poses for "
      "reconstruction, and the scene",
      {.words = {"vtk", "gsf", "las", "geotiff", "csv", "mcap", "png", "xtf", "neusis"}});
  add_world_options(list, p.world);
  list.add("--start-utc", &p.start_utc,
           "time of day at time 0, as 2026-05-01T08:30:00Z; default: that of the mission, else 1970");
  list.add(
      "--head", &p.head,
      "name of the head of a survey; default: a file for each head, soundings-NAME.gsf; an xtf has both heads of two");
  list.add("--crs", &p.crs, crs_help);
  list.add("--cell", &p.cell, "[m] size of the cells of a geotiff", {.positive = true});
  list.add("--per-beam", &p.per_beam, "most soundings of a beam, the strongest first",
           {.within = std::pair(1, 100), .shown_as = "INT"});
  list.add("--keep-rejected", &p.keep_rejected,
           "write rejected soundings too, with a flag; in geotiff in bands of their own");
  list.add("--min-level", &p.min_level, "[dB re 1 uPa] least level of a sounding");
  list.add("--max-deviation", &p.max_deviation, "[m] greatest predicted standard deviation of a sounding",
           {.positive = true});
  list.add("--processing-profile", &p.processing_profile,
           "sound-speed profile (.csv) that places the soundings; default: the profile of the simulation");
  list.add("--tide", &p.tide,
           "tide (.csv: time_s,height_m) by which heights are reduced to z = 0, or none: they count from the water "
           "level at each ping; default: the tide of the mission");
  list.add("--las-version", &p.las_version, "version of a las; 1.2 for readers that know no later one",
           {.words = {"1.4", "1.2"}});
  list.add("--compression", &p.compression,
           "compression of the chunks of an mcap; a method that this build lacks is noted and replaced by none",
           {.words = {"none", "lz4", "zstd"}});
  list.add("--linear", &p.linear,
           "mcap: 32-bit images of pressure in place of 8-bit levels; xtf: floats of received pressure in place of 16 "
           "bits with a gain");
  list.add("--force", &p.force, "replace an existing file, or the folder of an earlier export");
  add_common(list, o.common);
}

/// All fields that a cube holds per sample of a ping.
std::vector<SampleField> fields_of(const Ping& ping) {
  constexpr const char* level_unit = "dB re 1 uPa";
  const Grid<float> level = level_db(ping);
  std::vector<SampleField> fields = {
      {"level_db", level, level_unit},
      {"range_compensated_level_db", apply_tvg(level, ping.gate, Tvg{40, ping.absorption_db_per_m}),
       "dB re 1 uPa at 1 m"},
      {"pressure_re", ping.pressure.real(), "Pa, amplitude"},
      {"pressure_im", ping.pressure.imag(), "Pa, amplitude"}};
  for (const Layer& layer : ping.layers)
    fields.push_back({"level_db_" + layer.name, level_db(Ping{{}, ping.fan, ping.gate, layer.pressure}), level_unit});
  if (ping.intensity.size() > 0) fields.push_back({"shown_level_db", shown_level_db(ping), level_unit});
  if (ping.split_phase.size() > 0) fields.push_back({"split_phase", ping.split_phase, "rad"});
  if (ping.unknown.size() > 0) fields.push_back({"unknown", ping.unknown.cast<float>()});
  return fields;
}

/// Writes the returns of a run or of the head of a survey; how many, or nothing if there are none.
std::optional<std::size_t> save_returns(const RunPings& run, const std::string& path) {
  if (run.returns.empty()) return {};
  const SurveyReturns returns = load_survey_returns(run.returns);
  std::vector<PointColumn> more;
  if (!returns.time.empty())
    more = {{"time", "s", returns.time},
            {"head", "number in the mission, from 0", {returns.head.begin(), returns.head.end()}, true}};
  save_points(path, returns.soundings, more);
  return returns.soundings.size();
}

/// Throws for options of soundings beside a product that has none.
void require_soundings(const ProductOptions& o) {
  if ((o.to == "vtk" || o.to == "png" || o.to == "xtf" || o.to == "neusis") &&
      (o.keep_rejected || std::isfinite(o.min_level) || std::isfinite(o.max_deviation) ||
       !o.processing_profile.empty() || !o.tide.empty()))
    fail(ErrorKind::argument, "--to = ", o.to,
         " has no soundings of the bottom; --keep-rejected, --min-level, --max-deviation, --processing-profile and "
         "--tide need gsf, las, geotiff, csv or mcap");
}

/// Throws for a folder that is named like a file of another format.
void require_name_of_folder(const ProductOptions& o) {
  constexpr std::pair<const char*, const char*> files[] = {{".gsf", "gsf"}, {".las", "las"},   {".tif", "geotiff"},
                                                           {".csv", "csv"}, {".mcap", "mcap"}, {".xtf", "xtf"}};
  const std::string ending = std::filesystem::path(o.output).extension().string();
  for (const auto& [of_file, format] : files)
    if (ending == of_file)
      fail(ErrorKind::argument, "--output = ", o.output, ", but --to = ", o.to, " makes a folder; give --to ", format,
           " for a file, or the folder another name");
}

void export_for_paraview(const ProductOptions& o, const CommonOptions& common) {
  Progress progress(common, 2);
  progress.step("reading " + o.run);
  const RunPings run = find_run_pings(o.run, o.head);
  RunDirectory directory(o.output, o.force, {o.run});

  progress.step("writing " + o.output);
  std::vector<SeriesEntry> fans, images;
  each_ping(run, [&](const Cube&, const Ping& ping) {
    const std::size_t k = images.size();
    const std::vector<SampleField> fields = fields_of(ping);
    const auto files = save_fan_grid(directory.file(fmt::format("fan_{:06}.vts", k)), ping.fan, ping.gate, fields,
                                     ping.world_from_head);
    for (std::size_t part = 0; part < files.size(); ++part)
      fans.push_back({ping.time, static_cast<int>(part), files[part]});
    const std::string image = directory.file(fmt::format("image_{:06}.vti", k));
    save_sample_image(image, ping.fan, ping.gate, fields);
    images.push_back({ping.time, 0, image});
  });
  save_series(directory.file("fan.pvd"), fans);
  save_series(directory.file("image.pvd"), images);
  const std::optional<std::size_t> returns = save_returns(run, directory.file("returns.vtp"));
  write_manifest(directory, {{"schema", 1}, {"insonify_version", INSONIFY_VERSION}, {"exported", o.run}});
  directory.commit();
  print_summary(common,
                {{"output", o.output},
                 {"to", o.to},
                 {"pings", images.size()},
                 {"grids", fans.size()},
                 {"returns", returns.value_or(0)}},
                fmt::format("{}: {} grids and {} images of {} pings{}; open fan.pvd in ParaView", o.output, fans.size(),
                            images.size(), images.size(), returns ? fmt::format(", {} returns", *returns) : ""));
}

/// Returns an export for each head of a survey, unless one is named or the format holds all of them.
std::vector<ProductOptions> exports_of_heads(const ProductOptions& o) {
  const std::vector<std::string> heads = o.head.empty() ? head_names(o.run) : std::vector<std::string>{};
  if (heads.size() < 2 || o.to == "xtf") return {o};
  std::vector<ProductOptions> each(heads.size(), o);
  for (std::size_t h = 0; h < heads.size(); ++h)
    each[h].head = heads[h], each[h].output = output_of_head(o.output, heads[h]);
  return each;
}

void export_run(const ExportOptions& options) {
  require_soundings(options.product);
  if (options.product.to == "vtk") require_name_of_folder(options.product);
  if (const std::string& run = options.product.run; is_record(run))
    fail(ErrorKind::content, run,
         ": is a recording of a sonar, and export takes runs, surveys and cubes of insonify; "
         "`insonify image` draws a recording (a side-scan with --view waterfall), `insonify view` shows it, `insonify "
         "compare` compares it with a run");
  const std::vector<ProductOptions> exports = exports_of_heads(options.product);
  for (const ProductOptions& each : exports)
    if (exports.size() > 1) require_free_file(each.output, each.force, {each.run});
  for (const ProductOptions& each : exports)
    each.to == "vtk" ? export_for_paraview(each, options.common) : export_product(each, options.common);
}

}  // namespace

Verb export_verb() {
  return make_verb<ExportOptions>(
      "export", "a run for other programs: ParaView, hydrography, side-scan, GIS, ROS",
      {"insonify export out -o out-vtk", "insonify export survey -o vtk && paraview vtk/fan.pvd",
       "insonify export survey --to gsf --anchor 54.1,7.9,90 -o survey.gsf",
       "insonify export out --to mcap -o out.mcap", "insonify export survey --to xtf --anchor 54.1,7.9,90 -o line.xtf"},
      add_options, export_run);
}

}  // namespace insonify::tool
