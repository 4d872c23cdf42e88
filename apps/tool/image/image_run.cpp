// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "core/message.hpp"
#include "files/path_status.hpp"
#include "store/sonar_file.hpp"
#include "tool/image/image.hpp"
#include "tool/run/record_file.hpp"
#include "tool/run/run_pings.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

constexpr double default_tvg = 40;  // [dB per decade of range], a point's

/// Replaces the pressure of a ping by one of its layers.
void take_layer(Ping& ping, const std::string& name, const std::string& run) {
  const auto layer =
      std::find_if(ping.layers.begin(), ping.layers.end(), [&](const Layer& l) { return l.name == name; });
  if (layer == ping.layers.end())
    fail(ErrorKind::argument, "--layer = '", name, "' is not in ", run,
         ping.layers.empty() ? "; it has none: ping with --layers"
                             : "; it has " + shortened_list(ping.layers, ", ", &Layer::name));
  ping.pressure = std::move(layer->pressure);
  ping.layers.clear();
  ping.intensity.resize(0, 0);
}

}  // namespace

ImageRun read_image_run(const std::string& path, const std::string& layer) {
  if (is_record(path)) {
    if (!layer.empty()) fail(ErrorKind::argument, "--layer = '", layer, "': ", path, " is a recording, which has none");
    Record record = read_record(path);
    return {path, std::move(record.cube), {}, record.unit, record.side_scan};
  }
  ImageRun run{path, read_run_cube(path)};
  const fs::path settings = fs::path(path) / "run.toml";
  if (is_folder(path) && path_exists(settings))
    run.head = make_head(load_sonar_file(settings.string()).spec, run.cube.sound_speed);
  if (!layer.empty())
    for (Ping& ping : run.cube.pings) take_layer(ping, layer, path);
  return run;
}

std::optional<Tvg> tvg_of(const ImageOptions& o, double absorption_db_per_m, bool recording) {
  if (o.raw || (recording && !o.tvg)) return {};
  return Tvg{o.tvg.value_or(default_tvg), absorption_db_per_m};
}

LevelImage levels_of(const ImageRun& run, const ImageOptions& o, std::size_t ping) {
  const Ping& of = run.cube.pings[ping];
  LevelImage image = level_image(of, tvg_of(o, of.absorption_db_per_m, !run.unit.empty()));
  if (!run.unit.empty()) image.unit = run.unit;
  return image;
}

}  // namespace insonify::tool
