#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "core/error.hpp"
#include "store/cube.hpp"
#include "tool/parse_values.hpp"
#include "tool/run_files.hpp"
#include "tool/verbs.hpp"
#include "view/show_ascan.hpp"
#include "view/show_fan.hpp"
#include "view/show_grey.hpp"
#include "view/show_rect.hpp"

namespace insonify::tool {
namespace {

/// The cube of a run directory, or the path itself if it is a file.
std::string cube_path(const std::string& run) {
  if (!std::filesystem::exists(run)) fail(ErrorKind::file, run, ": no such run directory or cube");
  if (!std::filesystem::is_directory(run)) return run;
  const std::string path = run + "/cube.h5";
  if (!std::filesystem::exists(path)) fail(ErrorKind::content, run, ": holds no cube.h5, so it is no run directory");
  return path;
}

/// The ping with one of its layers in place of its pressure.
Ping layer_of(const Ping& ping, const std::string& name, const std::string& run) {
  std::string known;
  for (const Layer& layer : ping.layers) {
    if (layer.name == name) return {ping.number, ping.time, ping.world_from_head, ping.fan, ping.gate, layer.pressure};
    known += (known.empty() ? "" : ", ") + layer.name;
  }
  fail(ErrorKind::argument, "--layer = '", name, "' is not in ", run,
       known.empty() ? "; it has none: ping with --layers" : "; it has " + known);
}

/// The samples as grey values, from the brightest level down to the window's end.
void write_grey(const LevelImage& levels, const PictureOptions& picture, int bits, const std::string& path) {
  const double max_db = std::isnan(picture.max_db) ? levels.level_db.maxCoeff() : picture.max_db;
  const GreyWindow window{max_db - picture.window_db, max_db};
  if (bits == 8)
    show_grey(quantise_8(levels.level_db, window), levels.fan, path);
  else
    show_grey(quantise_16(levels.level_db, window), levels.fan, path);
}

}  // namespace

void image(const CommonOptions& common, const ImageOptions& o) {
  Progress progress(common, 2);
  PictureOptions picture;
  std::tie(picture.width, picture.height) = parse_size(o.size);
  picture.colour_map = o.colour_map;
  picture.window_db = o.window_db;
  picture.dark = o.dark;
  if (!(o.window_db > 0 && o.window_db <= 1000))
    fail(ErrorKind::argument, "--window = ", o.window_db, " dB, must be > 0 and at most 1000");
  if (!(std::abs(o.tvg) <= 1000)) fail(ErrorKind::argument, "--tvg = ", o.tvg, " dB, must be within -1000 and 1000");
  if (!o.max_db.empty()) picture.max_db = parse_number("--max", o.max_db);

  progress.step("reading " + o.run);
  const Cube cube = read_cube(cube_path(o.run));
  if (o.ping >= cube.pings.size())
    fail(ErrorKind::argument, "--ping = ", o.ping, ", must be below ", cube.pings.size(), ", the number of pings in ",
         o.run);
  const Ping& whole = cube.pings[o.ping];
  const Ping ping = o.layer.empty() ? whole : layer_of(whole, o.layer, o.run);
  const auto beams = static_cast<int>(ping.fan.beams());
  const int beam = o.beam < 0 ? beams / 2 : o.beam;
  if (beam >= beams) fail(ErrorKind::argument, "--beam = ", beam, ", must be below ", beams, ", the number of beams");

  progress.step("drawing " + o.output);
  const LevelImage levels =
      level_image(ping, o.raw ? std::nullopt : std::optional(Tvg{o.tvg, cube.absorption_db_per_m}));
  const std::string title = picture_title(cube.sonar, ping) + (o.layer.empty() ? "" : ", " + o.layer + " alone");
  picture.title = o.title.empty() ? title : o.title;
  if (o.view == "fan") show_fan(levels, picture, o.output);
  if (o.view == "rect") show_rect(levels, picture, o.output);
  if (o.view == "ascan") show_ascan(levels, static_cast<std::size_t>(beam), picture, o.output);
  if (o.view == "grey") write_grey(levels, picture, o.bits, o.output);
  fmt::print("{}\n", o.output);
}

}  // namespace insonify::tool
