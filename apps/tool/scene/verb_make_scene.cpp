// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/error.hpp"
#include "core/message.hpp"
#include "core/units.hpp"
#include "run/parse_values.hpp"
#include "scene/built_in_scenes.hpp"
#include "scene_io/save_cloud.hpp"
#include "store/material_library.hpp"
#include "store/materials_file.hpp"
#include "store/run_directory.hpp"
#include "store/scene_file.hpp"
#include "tiles/tile_writer.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"

namespace insonify::tool {
namespace {

constexpr std::size_t batch_surfels = 1 << 20;

struct MakeSceneOptions {
  CommonOptions common;
  std::string name;
  std::string output;
  std::uint64_t points = 200000;
  std::string size = "40,40";
  double radius = 0.5;
  double lambert_mu_db = -27;
  std::string materials_file;
  bool bare = false;
  bool force = false;
};

void add_options(OptionList list, MakeSceneOptions& o) {
  list.add("NAME", &o.name, "harbour, reef, river, plane, sphere, wall or poles", {.required = true});
  list.add("-o,--output", &o.output, "scene that is written: .ply or .pcd, or .tiles for scenes larger than memory",
           {.required = true});
  list.add("--points", &o.points, "number of surfels, at most 4 000 000 000", {.positive = true});
  list.add("--size", &o.size, "[m] plane: x,y extent; wall: width,height");
  list.add("--radius", &o.radius, "[m] radius of the sphere", {.positive = true});
  list.add("--mu-db", &o.lambert_mu_db, "[dB] 10 log10 of the Lambert coefficient of plane, sphere, wall and poles");
  list.add(
      "--materials", &o.materials_file,
      "TOML table whose materials replace materials of the same names; or `natural`: sediments, concrete, steel, rock");
  list.add("--bare", &o.bare, "write only points, as a scanner does; `prepare` adds normals and areas");
  list.add("--force", &o.force, "replace an existing file");
  add_common(list, o.common);
  list.add("--seed", &o.common.seed, "seed of jitter and ripples; the same seed gives the same bytes");
}

nlohmann::ordered_json summary_json(const MakeSceneOptions& o, std::size_t surfels,
                                    const std::vector<Material>& materials) {
  return {{"output", o.output},
          {"scene", o.name},
          {"surfels", surfels},
          {"seed", o.common.seed},
          {"materials", words_of(materials)}};
}

/// Replaces the materials that a table of the options has.
void replace_materials(const MakeSceneOptions& o, std::vector<Material>& materials) {
  if (o.materials_file.empty()) return;
  std::size_t replaced = 0;
  for (const SourcedMaterial& other : load_materials(path_of_materials(o.materials_file)).materials)
    for (Material& material : materials)
      if (material.name == other.material.name) material = other.material, ++replaced;
  if (replaced == 0)
    fail(ErrorKind::argument, "--materials = ", o.materials_file,
         ": has none of the scene's materials: ", shortened_list(words_of(materials)));
}

void make_scene_as_tiles(const MakeSceneOptions& o, const BuiltInSceneOptions& built_in, Progress& progress) {
  TileWriterOptions options;
  options.materials = empty_built_in_scene(o.name, built_in).materials;
  replace_materials(o, options.materials);
  TileWriter writer(o.output, options);
  make_built_in_scene_in_batches(o.name, built_in, batch_surfels, [&](const SceneCloud& batch) { writer.add(batch); });
  progress.step("writing " + o.output);
  const TileReport report = writer.finish();
  print_summary(o.common, summary_json(o, report.surfels, options.materials),
                fmt::format("{}: {} surfels in {} tiles, {} materials", o.output, report.surfels, report.tiles,
                            options.materials.size()));
}

/// Throws if the scene fits neither into memory, nor on the disk as tiles.
void require_room(const MakeSceneOptions& o) {
  constexpr double bytes_in_memory = 100, bytes_of_tiles = 170, gigabyte = 1e9;  // a surfel, while it is written
  const double points = static_cast<double>(o.points);
  if (kind_of_scene(o.output) == SceneKind::tiles) {
    const std::filesystem::path folder = std::filesystem::path(o.output).parent_path();
    std::error_code error;
    const auto space = std::filesystem::space(folder.empty() ? "." : folder, error);
    if (!error && points * bytes_of_tiles > static_cast<double>(space.available))
      fail(ErrorKind::file, o.output, ": ", o.points, " surfels take ", points * bytes_of_tiles / gigabyte,
           " GB while they are sorted, the disk has ", static_cast<double>(space.available) / gigabyte,
           "; give fewer --points, or another disk");
  } else {
    const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    if (points * bytes_in_memory > memory)
      fail(ErrorKind::argument, "--points = ", o.points, " take ", points * bytes_in_memory / gigabyte,
           " GB of memory, this computer has ", memory / gigabyte, "; write a .tiles file, or give fewer");
  }
}

void make_scene(const MakeSceneOptions& o) {
  require_free_file(o.output, o.force, {});
  require_room(o);
  const auto size = parse_numbers("--size", o.size, 2, "two lengths in metres, e.g. --size 40,40");
  if (!(size[0] > 0 && size[1] > 0)) fail(ErrorKind::argument, "--size = ", o.size, " m, both lengths must be above 0");
  const BuiltInSceneOptions built_in{
      o.points, {size[0], size[1]}, o.radius, power_from_db(o.lambert_mu_db), o.common.seed};
  Progress progress(o.common, 2);
  progress.step("making " + o.name);
  if (kind_of_scene(o.output) == SceneKind::tiles && o.bare)
    fail(ErrorKind::argument, "--bare: ", o.output, ": tiles are prepared surfels; write .ply or .pcd");
  in_words_of("make-scene", [&] { empty_built_in_scene(o.name, built_in); });
  if (kind_of_scene(o.output) == SceneKind::tiles) return make_scene_as_tiles(o, built_in, progress);
  SceneCloud scene = make_built_in_scene(o.name, built_in);
  replace_materials(o, scene.materials);
  progress.step("writing " + o.output);
  if (o.bare)
    save_bare_points(o.output, scene);
  else
    save_scene(o.output, scene);
  print_summary(o.common, summary_json(o, scene.size(), scene.materials),
                fmt::format("{}: {} surfels, {} materials", o.output, scene.size(), scene.materials.size()));
}

}  // namespace

Verb make_scene_verb() {
  return make_verb<MakeSceneOptions>(
      "make-scene", "a built-in scene with normals, areas and materials",
      {"insonify make-scene reef --bare -o reef.pcd", "insonify make-scene harbour -o harbour.ply --points 200000",
       "insonify make-scene plane -o plane.ply --size 40,40 --mu-db -27"},
      add_options, make_scene);
}

}  // namespace insonify::tool
