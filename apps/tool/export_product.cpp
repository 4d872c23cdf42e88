#include "tool/export_product.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "returns/quantise.hpp"
#include "store/run_directory.hpp"
#include "tool/product_run.hpp"
#include "tool/progress.hpp"
#include "tool/raster_plane.hpp"

namespace insonify::tool {
namespace {

constexpr double shown_span_db = 80;  // of images in 8 bits

/// Where the world is, if options or mission say so.
std::optional<Georeference> georeference_of(const ProductOptions& o, const RunPings& pings) {
  Georeference reference;
  if (!o.utm.empty()) reference.zone = parse_utm_zone(o.utm, "--utm");
  if (!o.anchor.empty())
    reference.anchor = parse_anchor(o.anchor, "--anchor");
  else if (pings.anchor)
    reference.anchor = *pings.anchor;
  else if (o.utm.empty())
    return {};
  return reference;
}

/// A product: its writer, and whether it needs a place on the globe.
struct Product {
  const char* name;
  bool placed;
  std::size_t (*write)(const PlacedRun& run);
};
constexpr Product products[] = {{"gsf", true, gsf_product},
                                {"las", true, las_product},
                                {"geotiff", true, geotiff_product},
                                {"csv", false, csv_product},
                                {"mcap", false, mcap_product}};

}  // namespace

UtmWorld::UtmWorld(const Georeference& from)
    : reference(from), zone(from.zone.value_or(utm_zone_of(geo_from_world(from, Eigen::Vector3d::Zero())))) {}

Eigen::Vector3d UtmWorld::place(const Eigen::Vector3d& world) const {
  if (reference.zone) return world;
  const UtmPlace utm = utm_place_of(geo_from_world(reference, world), zone);
  return {utm.easting, utm.northing, world.z()};
}

GreyScale::GreyScale(const Ping& first) {
  const double most =
      std::ceil(static_cast<double>(range_compensated_level_db(first, first.absorption_db_per_m).maxCoeff())) + 10;
  window = {most - shown_span_db, most};
}

std::size_t each_swath(const PlacedRun& run,
                       const std::function<void(const Cube&, const Ping&, const BottomSoundings&)>& use) {
  std::size_t pings = 0, soundings = 0;
  each_ping(run.pings, [&](const Cube& cube, const Ping& ping) {
    const BottomSoundings found =
        detect_bottom(ping, bottom_options(cube, ping, run.pings.environment, run.options.per_beam));
    ++pings;
    soundings += found.size();
    use(cube, ping, found);
  });
  if (pings == 0) fail(ErrorKind::content, run.options.run, ": has no pings");
  return soundings;
}

void export_product(const ProductOptions& o, const CommonOptions& common) {
  Progress progress(common, 2);
  progress.step("reading " + o.run);
  PlacedRun run{o, find_run_pings(o.run, o.head)};
  run.start = seconds_of_utc(o.start_utc.empty() ? run.pings.start_utc : o.start_utc);
  run.place = georeference_of(o, run.pings);
  if (o.to == "png") {
    RunDirectory directory(o.output, o.force, {o.run});
    progress.step("writing " + o.output);
    const std::size_t pings = png_product(run, directory);
    print_summary(common, {{"output", o.output}, {"to", o.to}, {"pings", pings}},
                  fmt::format("{}: pictures of {} pings; scales are in manifest.json", o.output, pings));
    return;
  }
  const auto& product =
      *std::find_if(std::begin(products), std::end(products), [&](const Product& each) { return o.to == each.name; });
  if (o.to == "las" && o.output.ends_with(".laz"))
    fail(ErrorKind::argument, "--output ", o.output,
         ": LAZ is not written, since Debian 12 has no library for it; write a ",
         ".las and pack it: laszip -i x.las -o x.laz, or pdal translate x.las x.laz");
  const bool raster = o.to == "geotiff";
  if (!o.crs.empty() && !raster)
    fail(ErrorKind::argument, "--crs goes with --to geotiff; --to ", o.to, " is in ",
         product.placed ? "the UTM zone or the degrees of its place" : "the axes of the world", ": leave --crs out");
  if (product.placed && !run.place && !RasterPlane::is_local(o.crs))
    fail(ErrorKind::argument, o.run, ": does not say where on the globe it is, which --to ", o.to,
         " needs; give --anchor LAT,LON[,HEADING] of the origin and x axis of its world, anchor in the mission, or ",
         "--utm ZONE of a world in UTM", raster ? "; or --crs local for a grid of the world's own plane" : "");
  require_free_file(o.output, o.force, {o.run});
  progress.step("writing " + o.output);
  const std::size_t soundings = product.write(run);
  if (const std::string note = o.to == "mcap" ? compression_note(o) : ""; !note.empty()) progress.note(note);
  print_summary(common, {{"output", o.output}, {"to", o.to}, {"soundings", soundings}},
                fmt::format("{}: {} soundings as {}", o.output, soundings, o.to));
}

}  // namespace insonify::tool
