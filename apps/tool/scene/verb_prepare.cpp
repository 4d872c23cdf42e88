// SPDX-License-Identifier: BSD-3-Clause
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/message.hpp"
#include "files/sha256.hpp"
#include "run/ping_setup.hpp"
#include "run/run_settings.hpp"
#include "run_scenes/open_scene.hpp"
#include "run_scenes/stored_levels.hpp"
#include "scene/thin_scene.hpp"
#include "scene_io/prepare_tiles.hpp"
#include "scene_io/save_cloud.hpp"
#include "store/run_directory.hpp"
#include "store/scene_file.hpp"
#include "tiles/tile_writer.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

struct PrepareOptions {
  CommonOptions common;
  SceneOptions scene;
  std::string output;
  double time = 0;      ///< time at which a scene of parts is taken [s]
  double thin = 0;      ///< [m] between the surfels that stay; 0: all stay
  bool levels = false;  ///< levels of detail are stored beside the output
  bool force = false;
  bool normals = false;  ///< without effect: missing normals are always estimated
};

void add_options(OptionList list, PrepareOptions& o) {
  add_scene(list, o.scene);
  list.add("-o,--output", &o.output,
           "prepared scene that is written: .ply or .pcd; or .tiles, of which a ping reads only what it reaches",
           {.required = true});
  list.add("--thin", &o.thin,
           "[m] least distance between surfels; denser parts are thinned, with their area and materials kept",
           {.positive = true});
  list.add("--levels", &o.levels,
           "store levels of detail in OUTPUT.tiles, too: pings of OUTPUT then read only what they reach, and merge "
           "surfels, as those of .tiles do");
  list.add("--time", &o.time, "[s] time at which the parts of a scene of parts are taken");
  list.add("--force", &o.force, "replace an existing file");
  list.add("--normals", &o.normals, "has no effect: missing normals are always estimated");
  add_common(list, o.common);
  add_work(list, o.common.threads, o.common.seed);
}

/// One cloud of a scene of parts, its surfels numbered through, with a column for the number of its part, from 1.
LoadedScene parts_as_cloud(LoadedScene loaded) {
  SceneCloud& scene = loaded.scene;
  SceneColumn instance{"instance", "uint16"};
  for (std::uint16_t& part : scene.part) ++part;
  const char* const bytes = reinterpret_cast<const char*>(scene.part.data());
  instance.bytes.assign(bytes, bytes + scene.part.size() * sizeof(scene.part[0]));
  loaded.columns.others.push_back(std::move(instance));
  scene.part.clear(), scene.parts.clear();
  std::iota(scene.id.begin(), scene.id.end(), 0u);
  return loaded;
}

void prepare_as_tiles(const PrepareOptions& o) {
  Progress progress(o.common, 1);
  progress.step("preparing " + o.output);
  PrepareTilesOptions options;
  options.load = load_options(o.scene, o.common.seed, o.common.threads);
  options.progress = [&](double part) {
    progress.show(part, fmt::format("preparing {}: {:.1f} %", o.output, 100 * part));
  };
  const PreparedTiles prepared = prepare_tiles(o.scene.path, o.output, options);
  auto notes = loading_notes(prepared.report);
  if (!prepared.report.other_columns.empty())
    notes.push_back(fmt::format("{}: tiles cannot store the columns {}; prepare a .ply to keep them", o.scene.path,
                                shortened_list(prepared.report.other_columns)));
  for (const std::string& note : notes) progress.note(note);
  const ordered_json result = {{"output", o.output},
                               {"points_read", prepared.report.points_read},
                               {"surfels", prepared.tiles.surfels},
                               {"tiles", prepared.tiles.tiles},
                               {"bytes", prepared.tiles.bytes},
                               {"area_m2", prepared.tiles.total_area},
                               {"normals_oriented", prepared.normals_oriented},
                               {"in_batches", prepared.streamed},
                               {"notes", notes}};
  print_summary(o.common, result,
                fmt::format("{}: {} surfels in {} tiles, {:.4g} m^2, normals {}", o.output, prepared.tiles.surfels,
                            prepared.tiles.tiles, prepared.tiles.total_area,
                            prepared.normals_oriented ? "oriented" : "two-sided"));
}

LoadedScene load_to_prepare(const PrepareOptions& o) {
  OpenSceneOptions options{{o.common.seed, {}}, o.common.threads};
  options.keep_columns = kind_of_scene(o.output) != SceneKind::tiles;
  const auto scene = open_scene(o.scene, options);
  LoadedScene whole = scene->take_whole({o.time, 0});
  return scene->parts() ? parts_as_cloud(std::move(whole)) : whole;
}

/// Throws Error(argument) or Error(file) if levels cannot be stored beside the output.
void require_place_of_levels(const PrepareOptions& o) {
  if (!o.levels) return;
  if (kind_of_scene(o.output) == SceneKind::tiles)
    fail(ErrorKind::argument, "--levels: ", o.output, " holds levels itself; leave the option out");
  require_free_file(levels_path(o.output), o.force, {o.scene.path, o.scene.materials_file});
}

/// Throws Error(argument) if a scene has a surface, which its levels would not have.
void require_surfels(const PrepareOptions& o, const LoadedScene& loaded) {
  if (o.levels && loaded.mesh)
    fail(ErrorKind::argument, "--levels: ", o.scene.path, " has a surface between its points, and levels are of ",
         "surfels; leave the option out, or prepare a .tiles file, whose surfels hide as discs");
}

/// Stores the levels of the output, once it is written.
void store_levels(const PrepareOptions& o, const LoadedScene& loaded, Progress& progress, ordered_json& result) {
  if (!o.levels) return;
  const std::string path = levels_path(o.output);
  progress.step("writing " + path);
  TileWriterOptions options;
  options.system = loaded.report.meaning.system.value;
  options.levels_of = sha256_of_file(o.output);
  options.threads = o.common.threads;
  const TileReport report = save_tiles(path, loaded.scene, options);
  result["levels"] = {{"output", path}, {"tiles", report.tiles}, {"bytes", report.bytes}};
}

void prepare(const PrepareOptions& o) {
  const bool of_parts = kind_of_scene(o.scene.path) == SceneKind::parts;
  const bool as_tiles = kind_of_scene(o.output) == SceneKind::tiles;
  if (o.time != 0 && !of_parts)
    fail(ErrorKind::argument, "--time: ", o.scene.path,
         " is no scene of parts, and nothing moves in it; leave --time out");
  require_free_file(o.output, o.force, {o.scene.path, o.scene.materials_file});
  require_place_of_levels(o);
  if (as_tiles && o.thin == 0 && !of_parts) return prepare_as_tiles(o);
  Progress progress(o.common, 2 + (o.thin > 0) + o.levels);
  progress.step("reading and completing " + o.scene.path);
  LoadedScene loaded = load_to_prepare(o);
  auto notes = loading_notes(loaded.report);
  if (o.thin > 0) {
    const std::size_t all = loaded.scene.size();
    progress.step(fmt::format("thinning {} surfels", all));
    SceneCloud thinned = thin_scene(loaded.scene, o.thin);
    loaded.columns = columns_of(loaded.columns, loaded.scene.id, thinned.id);
    loaded.scene = std::move(thinned);
    loaded.columns.heights = false;
    loaded.mesh.reset();
    notes.push_back(
        fmt::format("thinned to {} m: {} of {} surfels kept, with the area of all", o.thin, loaded.scene.size(), all));
  }
  require_surfels(o, loaded);
  const bool as_surfels = loaded.mesh && (as_tiles || !(loaded.columns.heights || o.output.ends_with(".ply")));
  if (as_surfels)
    notes.push_back(
        fmt::format("{} has no place for triangles: it holds {} surfels, which hide as discs; a .ply keeps the mesh",
                    o.output, loaded.scene.size()));
  for (const std::string& note : notes) progress.note(note);
  progress.step("writing " + o.output);
  if (as_tiles)
    save_tiles(o.output, loaded.scene, {.system = loaded.report.meaning.system.value});
  else
    save_scene(o.output, loaded);

  const double area = std::accumulate(loaded.scene.area.begin(), loaded.scene.area.end(), 0.0);
  ordered_json result = {
      {"output", o.output}, {"points_read", loaded.report.points_read},          {"surfels", loaded.scene.size()},
      {"area_m2", area},    {"normals_oriented", loaded.scene.normals_oriented}, {"notes", notes}};
  store_levels(o, loaded, progress, result);
  print_summary(o.common, result,
                fmt::format("{}: {} surfels, {:.4g} m^2, normals {}", o.output, loaded.scene.size(), area,
                            loaded.scene.normals_oriented ? "oriented" : "two-sided"));
}

}  // namespace

Verb prepare_verb() {
  return make_verb<PrepareOptions>(
      "prepare", "complete a cloud or mesh once: origin, normals, areas, materials",
      {"insonify prepare reef.pcd -o reef.ply --material sand",
       "insonify prepare scan.ply -o scan-m.ply --unit mm --viewpoint 0,0,2",
       "insonify prepare dense.pcd -o reef.ply --thin 0.02", "insonify prepare huge.las -o bay.ply --levels"},
      add_options, prepare);
}

}  // namespace insonify::tool
