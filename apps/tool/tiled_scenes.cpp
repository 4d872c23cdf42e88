#include "tool/tiled_scenes.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/units.hpp"
#include "scene/built_in_scenes.hpp"
#include "scene_io/prepare_tiles.hpp"
#include "scene_io/tiled_scene.hpp"
#include "simulate/resolve_ping.hpp"
#include "tool/parse_values.hpp"
#include "tool/ping_report.hpp"
#include "tool/progress.hpp"

namespace insonify::tool {

using nlohmann::ordered_json;

namespace {

constexpr double bytes_to_ping = 192;  ///< per surfel read: itself, in view, as scatterers and echoes
constexpr std::size_t batch_surfels = 1 << 20;

/// A .tiles scene is complete: what says how to complete one has no effect, which must not go unsaid.
void require_no_loading_options(const SceneOptions& o) {
  const SceneOptions none;
  const auto refuse = [&](bool given, const char* option) {
    if (given)
      fail(ErrorKind::argument, option, ": ", o.path, " is prepared already; give it to insonify prepare instead");
  };
  refuse(!o.viewpoint.empty(), "--viewpoint");
  refuse(!o.materials_file.empty(), "--materials");
  refuse(!o.material_field.empty(), "--material-field");
  refuse(!o.material.empty(), "--material");
  refuse(o.unit != none.unit, "--unit");
  refuse(o.mesh_spacing != none.mesh_spacing, "--mesh-spacing");
}

PingScene load_tiles_of_region(const CommonOptions& common, const PingOptions& o, const PingSetup& setup) {
  require_no_loading_options(o.scene);
  const TiledScene tiled(o.scene.path);
  const TiledSceneInfo& info = tiled.info();
  const TileSelection near = tiled.select(
      resolve_ping(info.whole, setup.head.head, setup.pose, setup.head.environment, setup.simulation).region);
  const double memory = o.memory_limit > 0 ? o.memory_limit * (1 << 30) : available_memory();
  require_memory(near, bytes_to_ping, memory, o.scene.path);

  PingScene result;
  result.loaded.scene = tiled.load(near, memory, common.threads);
  LoadReport& report = result.loaded.report;
  report.path = o.scene.path;
  report.format = "insonify tiles";
  report.points_read = near.surfels;
  report.notes.push_back(fmt::format("{} of {} surfels read, in {} of {} tiles", near.surfels, info.surfels,
                                     near.tiles.size(), info.tiles));
  for (const Eigen::Vector3d& place : tiled.places())
    result.places.push_back(setup.pose.linear().transpose() * (place - setup.pose.translation()));
  result.json = scene_json(result.loaded);
  result.json["tiles"] = {{"surfels", info.surfels},
                          {"surfels_read", near.surfels},
                          {"tiles", info.tiles},
                          {"tiles_read", near.tiles.size()},
                          {"bytes", info.bytes}};
  return result;
}

void require_free(const std::string& output, bool force) {
  if (!force && std::filesystem::exists(output))
    fail(ErrorKind::file, output, ": exists already; choose another name or add --force");
}

}  // namespace

bool is_tiles(const std::string& path) { return std::filesystem::path(path).extension() == ".tiles"; }

PingScene load_ping_scene(const CommonOptions& common, const PingOptions& o, const PingSetup& setup) {
  if (is_tiles(o.scene.path)) return load_tiles_of_region(common, o, setup);
  PingScene result{load_scene(o.scene.path, load_options(common, o.scene)), {}, {}};
  result.places = sampled_places(result.loaded.scene, setup.pose);
  require_in_reach(result.places, setup.head.head.gate, o.scene.path);
  result.json = scene_json(result.loaded);
  return result;
}

void prepare_as_tiles(const CommonOptions& common, const PrepareOptions& o) {
  require_free(o.output, o.force);
  Progress progress(common, 1);
  progress.step("preparing " + o.output);
  PrepareTilesOptions options;
  options.load = load_options(common, o.scene);
  options.progress = [&](double) { progress.check(); };
  const PreparedTiles prepared = prepare_tiles(o.scene.path, o.output, options);
  const auto notes = loading_notes(prepared.report);
  for (const std::string& note : notes) progress.note(note);
  if (common.json) {
    const ordered_json result = {{"output", o.output},
                                 {"points_read", prepared.report.points_read},
                                 {"surfels", prepared.tiles.surfels},
                                 {"tiles", prepared.tiles.tiles},
                                 {"bytes", prepared.tiles.bytes},
                                 {"area_m2", prepared.tiles.total_area},
                                 {"normals_oriented", prepared.normals_oriented},
                                 {"in_batches", prepared.streamed},
                                 {"notes", notes}};
    fmt::print("{}\n", result.dump(2));
  } else {
    fmt::print("{}: {} surfels in {} tiles, {:.4g} m^2, normals {}\n", o.output, prepared.tiles.surfels,
               prepared.tiles.tiles, prepared.tiles.total_area, prepared.normals_oriented ? "oriented" : "two-sided");
  }
}

void make_scene_as_tiles(const CommonOptions& common, const MakeSceneOptions& o) {
  require_free(o.output, o.force);
  const auto size = parse_numbers("--size", o.size, 2, "two lengths in metres, e.g. --size 40,40");
  const BuiltInSceneOptions built_in{
      o.points, {size[0], size[1]}, o.radius, power_from_db(o.lambert_mu_db), common.seed};
  Progress progress(common, 2);
  progress.step("making " + o.name);
  TileWriterOptions options;
  options.materials = empty_built_in_scene(o.name, built_in).materials;
  options.progress = [&](double) { progress.check(); };
  TileWriter writer(o.output, options);
  make_built_in_scene_in_batches(o.name, built_in, batch_surfels, [&](const SceneCloud& batch) {
    progress.check();
    writer.add(batch);
  });
  progress.step("writing " + o.output);
  const TileReport report = writer.finish();
  fmt::print("{}: {} surfels in {} tiles, {} materials\n", o.output, report.surfels, report.tiles,
             options.materials.size());
}

ordered_json tiles_summary(const std::string& path) {
  const TiledScene tiled(path);
  const TiledSceneInfo& info = tiled.info();
  const auto point = [](const Eigen::Vector3d& v) { return ordered_json{v.x(), v.y(), v.z()}; };
  ordered_json materials = ordered_json::array();
  for (const Material& m : info.materials) materials.push_back(m.name);
  ordered_json json = {{"path", path},
                       {"format", "insonify tiles"},
                       {"surfels", info.surfels},
                       {"tiles", info.tiles},
                       {"bytes", info.bytes},
                       {"origin", point(info.origin)},
                       {"area_m2", info.total_area},
                       {"mean_spacing_m", info.whole.mean_spacing},
                       {"largest_area_m2", info.whole.largest_area},
                       {"normals_oriented", info.normals_oriented},
                       {"materials", materials}};
  if (info.surfels > 0) json["bounds"] = {{"min", point(info.box.min)}, {"max", point(info.box.max)}};
  return json;
}

}  // namespace insonify::tool
