#include "tool/export_product.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/units.hpp"
#include "formats/geotiff_file.hpp"
#include "formats/gsf_file.hpp"
#include "formats/las_file.hpp"
#include "formats/mcap_file.hpp"
#include "formats/ros_messages.hpp"
#include "tool/progress.hpp"
#include "tool/run_pings.hpp"

namespace insonify::tool {
namespace {

constexpr double shown_span_db = 80;  // of images in 8 bits
constexpr int fan_rows_of_pixels = 480;

/// A run with its place and time.
struct PlacedRun {
  const ProductOptions& options;
  RunPings pings;
  Georeference reference{};
  double start = 0;  ///< seconds since 1970 of time 0
};

Georeference reference_of(const ProductOptions& o, const RunPings& pings) {
  Georeference reference;
  if (!o.utm.empty()) reference.zone = parse_utm_zone(o.utm, "--utm");
  if (!o.anchor.empty())
    reference.anchor = parse_anchor(o.anchor, "--anchor");
  else if (pings.anchor)
    reference.anchor = *pings.anchor;
  else if (o.utm.empty())
    fail(ErrorKind::argument, o.run, ": does not say where on the globe it is, which --to ", o.to,
         " needs; give --anchor LAT,LON[,HEADING] of the origin and x axis of its world, anchor in the mission, or "
         "--utm "
         "ZONE of a world in UTM");
  return reference;
}

/// Axes of the vessel at a head: ahead and to starboard, level, from the port axis of the head.
struct VesselAxes {
  Eigen::Vector3d ahead, starboard;
  double roll;  ///< starboard down [rad]
  explicit VesselAxes(const Pose& world_from_head) {
    const Eigen::Vector3d port = world_from_head.linear().col(1);
    ahead = port.cross(Eigen::Vector3d::UnitZ());
    ahead = ahead.norm() > 1e-6 ? ahead.normalized() : Eigen::Vector3d::UnitX();
    starboard = ahead.cross(Eigen::Vector3d::UnitZ());
    roll = std::asin(std::clamp(port.z(), -1.0, 1.0));
  }
};

/// A sounding where it lies on the globe, in axes of the vessel at its head.
GsfBeam placed_beam(const PlacedRun& run, const Anchor& here, const BottomSoundings& found, std::size_t i,
                    double sound_speed, GsfBeam beam) {
  const Eigen::Vector3d away = world_from_geo(here, geo_from_world(run.reference, found.position[i]));
  const auto deviation = static_cast<double>(found.deviation[i]);
  beam.detected = true;
  beam.depth = -found.position[i].z();
  beam.along = away.x(), beam.across = -away.y();
  beam.travel_time = 2 * found.range[i] / sound_speed;
  beam.level_db = static_cast<double>(found.level_db[i]);
  beam.quality = static_cast<double>(found.quality[i]);
  beam.vertical_deviation = deviation * std::cos(beam.angle);
  beam.horizontal_deviation = deviation * std::sin(beam.angle);
  return beam;
}

GsfPing gsf_ping(const PlacedRun& run, const Cube& cube, const Ping& ping, const BottomSoundings& found) {
  const Eigen::Vector3d head = ping.world_from_head.translation();
  const VesselAxes axes(ping.world_from_head);
  GsfPing out;
  out.time = run.start + ping.time;
  out.place = geo_from_world(run.reference, head);
  out.heading = out.course = heading_of(run.reference, head, axes.ahead);
  out.roll = axes.roll;
  out.number = static_cast<std::uint16_t>(ping.number);
  out.surface_sound_speed = cube.sound_speed;
  out.range = ping.gate.max_range;
  out.beam_width_along = ping.fan.elevation_width, out.beam_width_across = ping.fan.beam_width;
  const Anchor here{degrees(out.place.latitude), degrees(out.place.longitude), degrees(out.heading)};
  std::vector<std::size_t> sounding(ping.fan.beams(), found.size());
  for (std::size_t i = found.size(); i-- > 0;) sounding[found.beam[i]] = i;  // the first of each beam
  std::vector<std::pair<double, GsfBeam>> beams;
  for (std::size_t b = 0; b < ping.fan.beams(); ++b) {
    const Eigen::Vector3d axis =
        ping.world_from_head.linear() * unit_vector({ping.fan.azimuth[b], ping.fan.elevation[b]});
    GsfBeam beam;
    beam.angle = std::acos(std::clamp(-axis.z(), -1.0, 1.0));
    beam.azimuth = std::atan2(axis.dot(axes.ahead), axis.dot(axes.starboard));
    if (sounding[b] < found.size()) beam = placed_beam(run, here, found, sounding[b], cube.sound_speed, beam);
    beams.emplace_back(axis.dot(axes.starboard), beam);
  }
  std::stable_sort(beams.begin(), beams.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [across, beam] : beams) out.beams.push_back(beam);
  return out;
}

/// Calls `use` with every ping and its soundings; returns how many soundings there were.
template <typename Use>
std::size_t each_swath(const PlacedRun& run, const Use& use) {
  std::size_t soundings = 0;
  each_ping(run.pings, [&](const Cube& cube, const Ping& ping) {
    const BottomSoundings found =
        detect_bottom(ping, bottom_options(cube, run.pings.environment, run.options.per_beam));
    soundings += found.size();
    use(cube, ping, found);
  });
  return soundings;
}

std::size_t write_gsf(const PlacedRun& run) {
  std::unique_ptr<GsfFile> file;
  GsfPing last;
  const std::size_t soundings = each_swath(run, [&](const Cube& cube, const Ping& ping, const BottomSoundings& found) {
    GsfPing swath = gsf_ping(run, cube, ping, found);
    if (!file) {
      const SoundSpeedProfile uniform{{0}, {cube.sound_speed}};
      file = std::make_unique<GsfFile>(run.options.output, run.pings.environment.profile.value_or(uniform), swath.place,
                                       swath.time,
                                       std::vector<std::string>{"REFERENCE TIME=1970/001 00:00:00", "GEOID=WGS-84",
                                                                "TIDAL_DATUM=UNKNOWN", "PLATFORM_TYPE=SURFACE_SHIP"});
    } else if (swath.time > last.time) {
      const Anchor from{degrees(last.place.latitude), degrees(last.place.longitude), 0};
      const Eigen::Vector3d way = world_from_geo(from, swath.place);  // north, west
      swath.speed = std::hypot(way.x(), way.y()) / (swath.time - last.time);
      if (swath.speed > 0) swath.course = std::atan2(-way.y(), way.x());
    }
    file->add(swath);
    last = std::move(swath);
  });
  if (!file) fail(ErrorKind::content, run.options.run, ": has no pings");
  file->finish();
  return soundings;
}

/// The UTM zone of the product, and places in it.
struct UtmWorld {
  const Georeference& reference;
  UtmZone zone;
  explicit UtmWorld(const Georeference& from)
      : reference(from), zone(from.zone.value_or(utm_zone_of(geo_from_world(from, Eigen::Vector3d::Zero())))) {}
  Eigen::Vector3d place(const Eigen::Vector3d& world) const {
    if (reference.zone) return world;
    const UtmPlace utm = utm_place_of(geo_from_world(reference, world), zone);
    return {utm.easting, utm.northing, world.z()};
  }
};

std::size_t write_las(const PlacedRun& run) {
  const UtmWorld world(run.reference);
  std::unique_ptr<LasFile> file;
  const std::size_t soundings = each_swath(run, [&](const Cube&, const Ping& ping, const BottomSoundings& found) {
    if (!file)
      file = std::make_unique<LasFile>(run.options.output, world.zone, world.place(ping.world_from_head.translation()));
    for (std::size_t i = 0; i < found.size(); ++i)
      file->add({world.place(found.position[i]), run.start + ping.time, found.level_db[i], found.deviation[i],
                 static_cast<std::uint32_t>(ping.number), static_cast<std::uint16_t>(found.beam[i])});
  });
  if (!file) fail(ErrorKind::content, run.options.run, ": has no pings");
  file->finish();
  return soundings;
}

std::size_t write_raster(const PlacedRun& run) {
  struct Cell {
    double count = 0, height = 0, intensity = 0;
  };
  if (!(run.options.cell > 0)) fail(ErrorKind::argument, "--cell = ", run.options.cell, " m, must be > 0");
  const UtmWorld world(run.reference);
  std::map<std::pair<std::int64_t, std::int64_t>, Cell> cells;  // by row and column
  const std::size_t soundings = each_swath(run, [&](const Cube&, const Ping&, const BottomSoundings& found) {
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Eigen::Vector3d at = world.place(found.position[i]);
      Cell& cell = cells[{static_cast<std::int64_t>(std::floor(at.y() / run.options.cell)),
                          static_cast<std::int64_t>(std::floor(at.x() / run.options.cell))}];
      cell.count += 1;
      cell.height += at.z();
      cell.intensity += power_from_db(static_cast<double>(found.level_db[i]) + 30 * std::log10(found.range[i]));
    }
  });
  if (cells.empty()) fail(ErrorKind::content, run.options.run, ": has no soundings, so there is nothing to map");
  std::int64_t west = cells.begin()->first.second, east = west;
  for (const auto& [at, cell] : cells) west = std::min(west, at.second), east = std::max(east, at.second);
  const std::int64_t south = cells.begin()->first.first, rows = cells.rbegin()->first.first - south + 1;
  const std::int64_t columns = east - west + 1;
  if (static_cast<double>(rows) * static_cast<double>(columns) > 0x1p26)
    fail(ErrorKind::argument, "--cell = ", run.options.cell, " m gives ", rows, " x ", columns,
         " cells, must give at most 2^26");
  const Grid<float> none = Grid<float>::Constant(rows, columns, std::numeric_limits<float>::quiet_NaN());
  std::vector<GeoBand> bands = {
      {"height [m]", none}, {"level [dB re 1 uPa at 1 m]", none}, {"soundings", Grid<float>::Zero(rows, columns)}};
  for (const auto& [at, cell] : cells) {
    const std::int64_t row = at.first - south, column = at.second - west;
    bands[0].values(row, column) = static_cast<float>(cell.height / cell.count);
    bands[1].values(row, column) = static_cast<float>(db_from_power(cell.intensity / cell.count));
    bands[2].values(row, column) = static_cast<float>(cell.count);
  }
  write_geotiff(run.options.output, bands,
                {world.zone, static_cast<double>(west) * run.options.cell,
                 static_cast<double>(south) * run.options.cell, run.options.cell});
  return soundings;
}

/// Topics of a robot's log, made with the first ping, whose levels give the scale of images.
struct RobotLog {
  McapFile file;
  Tvg tvg;
  SonarImageScale scale;
  Eigen::Vector3d origin;
  std::uint16_t image, fan, points, transforms;

  RobotLog(const ProductOptions& o, const Cube& cube, const Ping& ping)
      : file(o.output), tvg{40, cube.absorption_db_per_m}, origin(ping.world_from_head.translation()) {
    // Single precision holds world coordinates to a millimetre up to some kilometres.
    origin = origin.norm() > 1e4 ? Eigen::Vector3d(origin.array().round()) : Eigen::Vector3d(0, 0, 0);
    const double most =
        std::ceil(static_cast<double>(range_compensated_level_db(ping, cube.absorption_db_per_m).maxCoeff())) + 10;
    scale = {o.linear,
             {most - shown_span_db, most},
             std::max(1e-12, 4 * static_cast<double>(ping.pressure.abs().maxCoeff()))};
    const std::map<std::string, std::string> greys = {{"black_db", fmt::format("{}", most - shown_span_db)},
                                                      {"white_db", fmt::format("{}", most)},
                                                      {"reference", "dB re 1 uPa at 1 m"}};
    const std::map<std::string, std::string> numbers = {{"full_scale_pa", fmt::format("{}", scale.full_scale)}};
    const std::map<std::string, std::string> place = {
        {"origin_m", fmt::format("{},{},{}", origin.x(), origin.y(), origin.z())}};
    const auto add = [&](const char* topic, const RosType& type, const std::map<std::string, std::string>& about) {
      return file.add_topic(topic, type.name, type.text, about);
    };
    image = add("/sonar/image", projected_sonar_image_type(), o.linear ? numbers : greys);
    fan = add("/sonar/fan", image_type(), greys);
    points = add("/sonar/points", point_cloud_type(), place);
    transforms = add("/tf", transforms_type(), place);
  }
};

std::size_t write_mcap(const PlacedRun& run) {
  std::unique_ptr<RobotLog> log;
  const std::size_t soundings = each_swath(run, [&](const Cube& cube, const Ping& ping, const BottomSoundings& found) {
    if (!log) log = std::make_unique<RobotLog>(run.options, cube, ping);
    const auto time = static_cast<std::uint64_t>(std::llround((run.start + ping.time) * 1e9));
    log->file.add(log->transforms, time, head_transforms(ping.world_from_head, log->origin, time));
    log->file.add(log->image, time,
                  projected_sonar_image(ping, time, cube.centre_frequency, cube.sound_speed, log->tvg, log->scale));
    log->file.add(log->fan, time, fan_image(ping, time, log->tvg, log->scale.window, fan_rows_of_pixels));
    log->file.add(log->points, time, point_cloud(found.position, found.level_db, log->origin, time));
  });
  if (!log) fail(ErrorKind::content, run.options.run, ": has no pings");
  log->file.finish();
  return soundings;
}

}  // namespace

void export_product(const ProductOptions& o, const CommonOptions& common) {
  Progress progress(common, 2);
  progress.step("reading " + o.run);
  PlacedRun run{o, find_run_pings(o.run, o.head)};
  if (o.to != "mcap") run.reference = reference_of(o, run.pings);
  run.start = seconds_of_utc(o.start_utc.empty() ? run.pings.start_utc : o.start_utc);
  progress.step("writing " + o.output);
  const std::size_t soundings = o.to == "gsf"    ? write_gsf(run)
                                : o.to == "las"  ? write_las(run)
                                : o.to == "mcap" ? write_mcap(run)
                                                 : write_raster(run);
  fmt::print("{}: {} soundings as {}\n", o.output, soundings, o.to);
}

}  // namespace insonify::tool
