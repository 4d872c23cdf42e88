// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "store/sonar_file.hpp"
#include "tool/image/image.hpp"
#include "tool/run/run_pings.hpp"

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

}  // namespace

ImageRun read_image_run(const std::string& path, const std::string& layer) {
  ImageRun run{path, read_run_cube(path)};
  const fs::path settings = fs::path(path) / "run.toml";
  if (fs::is_directory(path) && fs::exists(settings))
    run.head = make_head(load_sonar_file(settings.string()).spec, run.cube.sound_speed);
  if (!layer.empty())
    for (Ping& ping : run.cube.pings) take_layer(ping, layer, path);
  return run;
}

LevelImage levels_of(const ImageRun& run, const ImageOptions& o, std::size_t ping) {
  return level_image(run.cube.pings[ping],
                     o.raw ? std::nullopt : std::optional(Tvg{o.tvg, run.cube.pings[ping].absorption_db_per_m}));
}

}  // namespace insonify::tool
