// SPDX-License-Identifier: BSD-3-Clause
#include "tool/export/export_product.hpp"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "returns/quantise.hpp"
#include "store/csv_tables.hpp"
#include "store/run_directory.hpp"
#include "tool/command/progress.hpp"
#include "tool/export/product_run.hpp"
#include "tool/export/raster_plane.hpp"

namespace insonify::tool {
namespace {

constexpr double shown_span_db = 80;  // of images in 8 bits

/// Where the world is, if options, mission or scene say so. What needs no place is written without a system that GDAL
/// cannot serve.
std::optional<Georeference> georeference_of_run(const ProductOptions& o, const RunPings& pings, bool needed) {
  try {
    return georeference_of(o.world, {o.run, pings.system, pings.anchor}, ends_of(pings));
  } catch (const Error&) {
    if (needed || !o.world.empty()) throw;
    return {};
  }
}

/// A product: its writer, and whether it needs a position on the globe.
struct Product {
  const char* name;
  bool placed;
  SoundingCount (*write)(const PlacedRun& run);
};
constexpr Product products[] = {{"gsf", true, gsf_product},         {"las", true, las_product},
                                {"geotiff", true, geotiff_product}, {"csv", false, csv_product},
                                {"mcap", false, mcap_product},      {"xtf", true, xtf_product}};

/// The pings to write: of a survey those of one head, of its side-scans in an xtf all if there are two.
PlacedRun placed_run(const ProductOptions& o) {
  const std::vector<std::string> heads =
      o.to == "xtf" && o.head.empty() ? head_names(o.run) : std::vector<std::string>{};
  if (heads.size() != 2) return {o, find_run_pings(o.run, o.head)};
  PlacedRun run{o, find_run_pings(o.run, heads[0])};
  run.others.push_back(find_run_pings(o.run, heads[1]));
  return run;
}

void export_folder(const PlacedRun& run, const CommonOptions& common, Progress& progress) {
  const ProductOptions& o = run.options;
  RunDirectory directory(o.output, o.force, {o.run});
  progress.step("writing " + o.output);
  const bool pictures = o.to == "png";
  std::vector<std::string> notes;
  const std::size_t pings = pictures ? png_product(run, directory) : neusis_product(run, directory, notes);
  for (const std::string& note : notes) progress.note(note);
  print_summary(common, {{"output", o.output}, {"to", o.to}, {"pings", pings}},
                pictures ? fmt::format("{}: pictures of {} pings; scales are in manifest.json", o.output, pings)
                         : fmt::format("{}: images, poses and scene of {} pings", o.output, pings));
}

}  // namespace

GreyScale::GreyScale(const Ping& first) {
  const double most =
      std::ceil(static_cast<double>(range_compensated_level_db(first, first.absorption_db_per_m).maxCoeff())) + 10;
  window = {most - shown_span_db, most};
}

std::string file_name_of(const std::string& path) { return std::filesystem::path(path).filename().string(); }

std::string profile_name(const ProductOptions& options) { return file_name_of(options.processing_profile); }

std::string profile_remark(const ProductOptions& options) {
  return options.processing_profile.empty() ? "" : "processing profile: " + profile_name(options);
}

SoundingCount each_swath(const PlacedRun& run,
                         const std::function<void(const Cube&, const Ping&, const BottomSoundings&)>& use) {
  const ProductOptions& o = run.options;
  SoundingCount count;
  std::size_t pings = 0;
  each_ping(run.pings, [&](const Cube& cube, const Ping& as_stored) {
    std::optional<Ping> raised;
    if (const double by = raised_by(run.pings, as_stored.time); by != 0)
      raised.emplace(as_stored).world_from_head.translation().z() += by;
    const Ping& ping = raised ? *raised : as_stored;
    BottomOptions how = bottom_options(cube, ping, run.pings, o.per_beam);
    if (run.processing_profile) how.profile = run.processing_profile;
    BottomSoundings found = detect_bottom(ping, how);
    std::vector<char> keep(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      count.rejected += found.reject[i] != 0;
      keep[i] = (o.keep_rejected || found.reject[i] == 0) && static_cast<double>(found.level_db[i]) >= o.min_level &&
                static_cast<double>(found.deviation[i]) <= o.max_deviation;
    }
    keep_soundings(found, keep);
    ++pings;
    count.soundings += found.size();
    use(cube, ping, found);
  });
  if (pings == 0) fail(ErrorKind::content, o.run, ": has no pings");
  return count;
}

namespace {

/// Reads the tide by which the heights of a product are reduced. Throws Error(argument) for a run that has none itself.
void read_reduction(const ProductOptions& o, RunPings& pings) {
  if (o.tide.empty()) return;
  if (pings.tide.time.empty() && !water_level(pings, 0))
    fail(ErrorKind::argument, "--tide ", o.tide, ": ", o.run,
         " does not say where its water level is, from which its heights could be reduced; give [tide], or level_m in ",
         "[water] of the mission");
  constexpr double ever = 1e12;  // [s]
  pings.reduction = o.tide == "none" ? TideSeries{{-ever, ever}, {0, 0}} : load_tide(o.tide);
}

}  // namespace

void export_product(const ProductOptions& options, const CommonOptions& common) {
  Progress progress(common, 2);
  progress.step("reading " + options.run);
  ProductOptions o = options;
  PlacedRun run = placed_run(o);
  if (o.processing_profile.empty()) o.processing_profile = run.pings.assumed_profile;
  read_reduction(o, run.pings);
  for (const std::string& note : run.pings.notes) progress.note(note);
  run.start = seconds_of_utc(o.start_utc.empty() ? run.pings.start_utc : o.start_utc);
  if (!o.processing_profile.empty()) run.processing_profile = load_sound_speed_profile(o.processing_profile);
  if (o.to == "png" || o.to == "neusis") return export_folder(run, common, progress);
  const auto& product =
      *std::find_if(std::begin(products), std::end(products), [&](const Product& each) { return o.to == each.name; });
  if (o.to == "las" && o.output.ends_with(".laz"))
    fail(ErrorKind::argument, "--output ", o.output,
         ": LAZ is not written, since Debian 12 has no library for it; give a name that ends in .las, "
         "which every reader of LAZ takes too");
  const bool raster = o.to == "geotiff";
  if (!o.crs.empty() && !raster)
    fail(ErrorKind::argument, "--crs goes with --to geotiff; --to ", o.to, " is in ",
         product.placed ? "the UTM zone or the degrees of its place" : "the axes of the world", ": leave --crs out");
  run.georeference = georeference_of_run(o, run.pings, product.placed && !RasterPlane::is_local(o.crs));
  if (product.placed && !run.georeference && !RasterPlane::is_local(o.crs))
    fail(ErrorKind::argument, o.run, ": does not say where on the globe it is, which --to ", o.to,
         " needs; give --anchor LAT,LON[,HEADING] of the origin and x axis of its world, anchor in the mission, or ",
         "--utm ZONE of a world in UTM, or --system EPSG:N of one in another projected system",
         raster ? "; or --crs local for a grid of the world's own plane" : "");
  require_free_file(o.output, o.force, {o.run});
  if (const std::string note = utm_note(o.world, {o.run, run.pings.system}); !note.empty()) progress.note(note);
  progress.step("writing " + o.output);
  const SoundingCount count = product.write(run);
  for (const std::string& note : count.notes) progress.note(note);
  if (const std::string note = o.to == "mcap" ? compression_note(o) : ""; !note.empty()) progress.note(note);
  if (o.to == "xtf") {
    print_summary(common, {{"output", o.output}, {"to", o.to}, {"pings", count.pings}},
                  fmt::format("{}: {} pings as xtf", o.output, count.pings));
    return;
  }
  nlohmann::ordered_json summary = {
      {"output", o.output}, {"to", o.to}, {"soundings", count.soundings}, {"rejected", count.rejected}};
  if (!o.processing_profile.empty()) summary["processing_profile"] = profile_name(o);
  const char* what_of_rejected = !o.keep_rejected ? "are left out"
                                 : raster         ? "are among them, in the bands rejected and rejected_height"
                                                  : "are among them, flagged";
  print_summary(common, summary,
                fmt::format("{}: {} soundings as {}; {} rejected {} {}", o.output, count.soundings, o.to,
                            count.rejected, count.rejected == 1 ? "one" : "ones", what_of_rejected));
}

}  // namespace insonify::tool
