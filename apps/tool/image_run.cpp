#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "store/sonar_file.hpp"
#include "tool/image.hpp"
#include "tool/run_files.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

/// The cube of a run directory, or the path itself if it is a file.
std::string cube_path(const std::string& run) {
  if (!fs::exists(run)) fail(ErrorKind::file, run, ": no such run directory or cube");
  if (!fs::is_directory(run)) return run;
  const std::string path = run + "/cube.h5";
  if (!fs::exists(path)) fail(ErrorKind::content, run, ": holds no cube.h5, so it is no run directory");
  return path;
}

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

}  // namespace

Cube read_run_cube(const std::string& path) { return read_cube(cube_path(path)); }

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
  std::tie(picture.width, picture.height) = parse_size(o.size);
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
                     o.raw ? std::nullopt : std::optional(Tvg{o.tvg, run.cube.absorption_db_per_m}));
}

}  // namespace insonify::tool
