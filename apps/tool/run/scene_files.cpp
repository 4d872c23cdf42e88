// SPDX-License-Identifier: BSD-3-Clause
#include "tool/run/scene_files.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "run/scene_reach.hpp"
#include "run_scenes/parts_of_pings.hpp"
#include "run_scenes/ping_report.hpp"
#include "sampling/scene_cut.hpp"
#include "scene_io/cloud_field.hpp"
#include "simulate/resolve_ping.hpp"
#include "survey/mesh_source.hpp"

namespace insonify::tool {

using nlohmann::ordered_json;

SceneInstances instances_of_scene(const std::string& path) {
  if (is_tiles(path) || is_scene_file(path) || !has_cloud_field(path, "instance")) return {};
  const CloudField field = load_cloud_field(path, "instance");
  std::vector<std::pair<std::uint32_t, std::uint32_t>> given;
  for (std::size_t i = 0; i < field.value.size(); ++i)
    if (const double value = field.value[i]; value >= 1 && value < 4294967295.0 && value == std::floor(value))
      given.emplace_back(field.id[i], static_cast<std::uint32_t>(value));
  return number_instances(given);
}

PingScene load_ping_scene(const PingOptions& o, const PingSimulator& simulator, const PingEvent& event,
                          const TiledScene& tiled) {
  require_no_loading_options(o.scene, "is prepared already; give it to insonify prepare instead");
  const TiledSceneInfo& info = tiled.info();
  const double memory = memory_for_tiles(o.memory_limit);
  PingScene result;
  LoadReport& report = result.loaded.report;
  report.path = o.scene.path;
  report.format = "insonify tiles";
  report.meaning.system = {info.system, MeaningOrigin::file};
  ordered_json read = {{"surfels", info.surfels}, {"tiles", info.tiles}, {"bytes", info.bytes}};
  const ResolvedPing ping =
      resolve_ping(info.whole, simulator.head(), event, simulator.environment(), simulator.options(), "ping");
  if (merges_surfels({}, ping.options)) {
    const SamplingSettings& sampling = ping.options.sampling;
    TiledCut cut = tiled.cut(
        ping.region, ping.view.fan, ping.view.gate,
        {sampling.detail_width, sampling.detail_spacing, ping.view.sampling.range_resolution, o.common.threads},
        memory / bytes_to_ping);
    result.loaded.scene = std::move(cut.scene);
    report.points_read = result.loaded.scene.size();
    report.notes.push_back(fmt::format("{} surfels and nodes of {} surfels, from {} of {} bytes", report.points_read,
                                       info.surfels, cut.bytes, info.bytes));
    read["bytes_read"] = cut.bytes;
  } else {
    const TileSelection near = tiled.select(ping.region);
    require_memory(near, bytes_to_ping, memory, o.scene.path);
    result.loaded.scene = tiled.load(near, memory, o.common.threads);
    report.points_read = near.surfels;
    report.notes.push_back(fmt::format("{} of {} surfels read, in {} of {} tiles", near.surfels, info.surfels,
                                       near.tiles.size(), info.tiles));
    read["tiles_read"] = near.tiles.size();
  }
  read["surfels_read"] = report.points_read;
  for (const Eigen::Vector3d& place : tiled.places())
    result.places.push_back(event.world_from_head.linear().transpose() * (place - event.world_from_head.translation()));
  result.json = scene_json(result.loaded.report, result.loaded.scene);
  result.json["tiles"] = std::move(read);
  return result;
}

namespace {

/// Loads a scene of parts as it is when the ping is sent.
PingScene load_parts(const PingOptions& o, PingSetup& setup) {
  require_no_loading_options(o.scene, "says itself how each part is read; give it there");
  const RunDraws draws{o.common.seed, {0, static_cast<std::uint64_t>(o.draw)}};
  const PartsOfPings all(o.scene.path, {draws, o.common.threads, o.memory_limit});
  const PartsScene& parts = all.scene();
  if (o.draw > 0 && parts.file().scatters.empty())
    fail(ErrorKind::argument, "--draw = ", o.draw, ": ", o.scene.path, " has no [[scatter]] to draw; leave it out");
  const SceneMoment moment = all.moment_of(setup.event.time, setup.event.number);
  const Bounds box = parts.box_at(moment.time, moment.draw);
  end_range_with_scene(setup.head, box, setup.event.world_from_head);
  PingScene result{{{}, parts.report()}, {}, {}, {}};
  if (parts.has_tiles()) {
    result.loaded = parts.scene_of(setup.simulator(), setup.event, moment.draw, memory_for_tiles(o.memory_limit));
  } else {
    result.posed = all.whole_at(moment);
  }
  const SceneCloud& scene = result.cloud();
  for (std::string& note : fit_notes(scene, box, setup)) setup.head.notes.push_back(std::move(note));
  result.places = sampled_places(scene, setup.event.world_from_head);
  if (!parts.has_tiles()) require_in_reach(result.places, setup.head.head.gate, o.scene.path);
  result.json = scene_json(result.loaded.report, scene);
  result.json["parts"] = parts.parts_json(moment.time, moment.draw);
  return result;
}

}  // namespace

PingScene load_ping_scene(const PingOptions& o, PingSetup& setup) {
  if (is_scene_file(o.scene.path)) return load_parts(o, setup);
  if (o.draw > 0)
    fail(ErrorKind::argument, "--draw = ", o.draw, ": ", o.scene.path, " is no scene of parts; leave it out");
  const auto add_notes = [&](const SceneCloud& scene, const Bounds& box) {
    for (std::string& note : fit_notes(scene, box, setup)) setup.head.notes.push_back(std::move(note));
  };
  if (is_tiles(o.scene.path)) {
    const TiledScene tiled(o.scene.path);
    end_range_with_scene(setup.head, tiled.info().box, setup.event.world_from_head);
    PingScene result = load_ping_scene(o, setup.simulator(), setup.event, tiled);
    add_notes(result.loaded.scene, tiled.info().box);
    return result;
  }
  PingScene result{load_scene(o.scene.path, load_options(o.common, o.scene)), {}, {}, {}};
  const Bounds box = bounds(result.loaded.scene);
  end_range_with_scene(setup.head, box, setup.event.world_from_head);
  add_notes(result.loaded.scene, box);
  result.places = sampled_places(result.loaded.scene, setup.event.world_from_head);
  require_in_reach(result.places, setup.head.head.gate, o.scene.path);
  sample_for_ping(o, setup, result.loaded);
  result.json = scene_json(result.loaded.report, result.loaded.scene);
  return result;
}

}  // namespace insonify::tool
