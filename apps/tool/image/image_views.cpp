// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/message.hpp"
#include "core/units.hpp"
#include "files/path_status.hpp"
#include "run_scenes/run_folder.hpp"
#include "run_scenes/stored_run.hpp"
#include "store/sonar_file.hpp"
#include "tool/image/image.hpp"
#include "tool/run/record_file.hpp"
#include "tool/run/run_pings.hpp"
#include "view/colour_maps_internal.hpp"

namespace insonify::tool {
namespace {

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

/// Reads all pings of a run. Those of a head of a survey that is not merged are in blocks.
Cube read_whole_cube(const std::string& path) {
  const std::vector<std::string> cubes = find_run_pings(path, "").cubes;
  if (cubes.empty()) fail(ErrorKind::content, path, ": has no ping, all of its pings failed");
  Cube whole = read_cube(cubes.front());
  for (std::size_t k = 1; k < cubes.size(); ++k) {
    Cube more = read_cube(cubes[k]);
    std::move(more.pings.begin(), more.pings.end(), std::back_inserter(whole.pings));
  }
  return whole;
}

}  // namespace

// CMake writes the table, VIEW(fan) VIEW(rect) ..., from the list of views.
#define VIEW(name) ViewSpec name##_view();
#include "view_table.inc"
#undef VIEW

const std::vector<ViewSpec>& all_views() {
  static const std::vector<ViewSpec> views{
#define VIEW(name) name##_view(),
#include "view_table.inc"
#undef VIEW
  };
  return views;
}

LevelImage levels_of(const PictureRequest& job) { return levels_of(job.run, job.options, job.ping); }

const BeamFan& fan_of(const PictureRequest& job) { return job.run.cube.pings[job.ping].fan; }

std::string beam_text(const ChosenBeam& chosen, const BeamFan& fan) {
  if (chosen.choice == BeamChoice::strongest) return "strongest over all beams";
  if (chosen.choice == BeamChoice::mean) return "mean of all beams";
  const double bearing = -degrees(fan.azimuth[chosen.beam]);
  return fmt::format("beam {} at {:+.1f}°", chosen.beam, std::abs(bearing) < 0.05 ? 0.0 : bearing);
}

double max_db_of_image(const PictureRequest& job) {
  return automatic_max_db(levels_of(job).level_db, job.picture.window_db);
}

BeamRecord beam_record(const ImageRun& run, const ImageOptions& o, const std::vector<std::size_t>& pings) {
  const Ping& first = run.cube.pings[pings.front()];
  const ChosenBeam chosen = choose_beam(o, first.fan);
  BeamRecord record{{}, first.gate, {}, levels_of(run, o, pings.front()).unit};
  record.level_db.resize(std::ssize(pings), static_cast<Eigen::Index>(first.gate.bins()));
  for (const std::size_t p : pings) {
    const Grid<float> level_db = levels_of(run, o, p).level_db;
    auto row = record.level_db.row(std::ssize(record.pings));
    if (chosen.choice == BeamChoice::one)
      row = level_db.row(static_cast<Eigen::Index>(chosen.beam));
    else
      row = level_db.colwise().maxCoeff();
    record.pings.push_back(run.cube.pings[p]);
  }
  return record;
}

const ViewSpec& view_of(const ImageOptions& o) {
  const auto is_requested = [&](const ViewSpec& view) { return o.view == view.name; };
  return *std::find_if(all_views().begin(), all_views().end(), is_requested);
}

ChosenBeam choose_beam(const ImageOptions& o, const BeamFan& fan) {
  const ViewSpec& view = view_of(o);
  const std::size_t beams = fan.beams();
  if (o.beam.empty()) return {view.default_choice, middle_beam(fan)};
  if (o.beam == view.beam_word) return {view.beam_choice};
  const double beam = parse_number("--beam", o.beam);
  if (!(beam >= 0 && beam == std::floor(beam)))
    fail(ErrorKind::argument, "--beam = ", o.beam, ", must be the number of a beam, from 0");
  if (beam >= static_cast<double>(beams))
    fail(ErrorKind::argument, "--beam = ", o.beam, ", must be below ", beams, ", the number of beams");
  return {BeamChoice::one, static_cast<std::size_t>(beam)};
}

std::string default_title(const ImageRun& run, const ImageOptions& o, std::size_t ping) {
  if (!run.unit.empty()) return fmt::format("{}, ping {}", run.cube.sonar, run.cube.pings[ping].number);
  return picture_title(run.cube.sonar, run.cube.pings[ping]) + (o.layer.empty() ? "" : ", " + o.layer + " alone");
}

ImageRun read_image_run(const std::string& path, const std::string& layer) {
  if (is_record(path)) {
    if (!layer.empty()) fail(ErrorKind::argument, "--layer = '", layer, "': ", path, " is a recording, which has none");
    Record record = read_record(path);
    return {path, std::move(record.cube), {}, record.unit, record.side_scan};
  }
  ImageRun run{path, read_whole_cube(path)};
  if (const std::string settings = StoredRun(path).find("run.toml"); !settings.empty())
    run.head = make_head(load_sonar_file(settings).spec, run.cube.sound_speed);
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
