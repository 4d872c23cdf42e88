#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/pose.hpp"
#include "core/units.hpp"
#include "store/sonar_file.hpp"
#include "tool/image/image.hpp"
#include "tool/run/run_files.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

/// Replaces the pressure of a ping by one of its layers.
void take_layer(Ping& ping, const std::string& name, const std::string& run) {
  const auto layer =
      std::find_if(ping.layers.begin(), ping.layers.end(), [&](const Layer& l) { return l.name == name; });
  if (layer == ping.layers.end())
    fail(ErrorKind::argument, "--layer = '", name, "' is not in ", run,
         ping.layers.empty() ? "; it has none: ping with --layers"
                             : "; it has " + joined(ping.layers, ", ", &Layer::name));
  ping.pressure = std::move(layer->pressure);
  ping.layers.clear();
  ping.intensity.resize(0, 0);
}

/// Rounds to a multiple of `step`, without negative zero.
double rounded(double value, double step) {
  const double nearest = step * std::round(value / step);
  return nearest == 0 ? 0 : nearest;
}

std::string position_text(const Pose& pose) {
  const Eigen::Vector3d at = pose.translation();
  return fmt::format("{:.2f}, {:.2f}, {:.2f} m", rounded(at.x(), 0.01), rounded(at.y(), 0.01), rounded(at.z(), 0.01));
}

/// Angles as --pose takes them.
std::string attitude_text(const Pose& pose) {
  const HeadPlace head = head_place(pose);
  return fmt::format("yaw {:.1f}°, pitch {:.1f}°, roll {:.1f}°", rounded(degrees(head.yaw), 0.1),
                     rounded(degrees(head.pitch), 0.1), rounded(degrees(head.roll), 0.1));
}

std::string fan_text(const BeamFan& fan) {
  const auto [low, high] = std::minmax_element(fan.azimuth.begin(), fan.azimuth.end());
  return fmt::format("{} over {:.1f}°, {:.2g}° x {:.3g}° wide", fan.beams(), degrees(*high - *low),
                     degrees(fan.beam_width), degrees(fan.elevation_width));
}

}  // namespace

std::string run_cube_path(const std::string& run) {
  if (!fs::exists(run)) fail(ErrorKind::file, run, ": no such run directory or cube");
  if (!fs::is_directory(run)) return run;
  std::string path = run + "/cube.h5";
  if (!fs::exists(path)) fail(ErrorKind::content, run, ": holds no cube.h5, so it is no run directory");
  return path;
}

Cube read_run_cube(const std::string& path) { return read_cube(run_cube_path(path)); }

ImageRun read_image_run(const std::string& path, const std::string& layer) {
  ImageRun run{path, read_run_cube(path)};
  const fs::path settings = fs::path(path) / "run.toml";
  if (fs::is_directory(path) && fs::exists(settings))
    run.head = make_head(load_sonar_file(settings.string()).spec, run.cube.sound_speed);
  if (!layer.empty())
    for (Ping& ping : run.cube.pings) take_layer(ping, layer, path);
  return run;
}

PictureOptions picture_options(const ImageOptions& o) {
  PictureOptions picture;
  picture.trim = o.size.empty();
  if (!o.size.empty()) std::tie(picture.width, picture.height) = parse_size(o.size);
  picture.colour_map = o.colour_map;
  picture.window_db = o.window_db;
  picture.dark = o.dark;
  if (!(o.window_db > 0 && o.window_db <= 1000))
    fail(ErrorKind::argument, "--window = ", o.window_db, " dB, must be > 0 and at most 1000");
  if (!(std::abs(o.tvg) <= 1000)) fail(ErrorKind::argument, "--tvg = ", o.tvg, " dB, must be within -1000 and 1000");
  if (!o.max_db.empty()) picture.max_db = parse_number("--max", o.max_db);
  return picture;
}

LevelImage levels_of(const ImageRun& run, const ImageOptions& o, std::size_t ping) {
  return level_image(run.cube.pings[ping],
                     o.raw ? std::nullopt : std::optional(Tvg{o.tvg, run.cube.pings[ping].absorption_db_per_m}));
}

std::vector<Fact> facts_of(const Cube& cube, std::size_t number) {
  const Ping& ping = cube.pings[number];
  const double loudest = pressure_level_db(ping.pressure.abs().maxCoeff());
  return {{"Sonar", cube.sonar},
          {"Pulse", fmt::format("{:g} kHz, {:g} kHz wide", cube.centre_frequency / 1000, cube.bandwidth / 1000)},
          {"Source level", fmt::format("{:g} dB re 1 µPa at 1 m", cube.source_level_db)},
          {"Ping", fmt::format("{} of {}, at {:g} s", number + 1, cube.pings.size(), ping.time)},
          {"Position", position_text(ping.world_from_head)},
          {"Attitude", attitude_text(ping.world_from_head)},
          {"Beams", fan_text(ping.fan)},
          {"Range", fmt::format("{:g} to {:g} m", ping.gate.min_range, ping.gate.max_range)},
          {"Bins", fmt::format("{} of {:.3g} mm", ping.gate.bins(), 1000 * ping.gate.bin_size)},
          {"Sound speed", fmt::format("{:.1f} m/s", ping.sound_speed)},
          {"Absorption", fmt::format("{:.3g} dB/km", 1000 * ping.absorption_db_per_m)},
          {"Loudest sample", loudest > silence_db ? fmt::format("{:.1f} dB re 1 µPa", loudest) : "silence"},
          {"Tolerance", fmt::format("{:g}", cube.tolerance)},
          {"Seed", fmt::format("{}", cube.seed)}};
}

}  // namespace insonify::tool
