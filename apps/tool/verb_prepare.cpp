#include <filesystem>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "scene/thin_scene.hpp"
#include "scene_io/save_cloud.hpp"
#include "scene_io/tile_writer.hpp"
#include "tool/head_setup.hpp"
#include "tool/progress.hpp"
#include "tool/tiled_scenes.hpp"
#include "tool/verbs.hpp"

namespace insonify::tool {

void prepare(const CommonOptions& common, const PrepareOptions& o) {
  if (is_tiles(o.output) && o.thin == 0) return prepare_as_tiles(common, o);
  if (!o.force && std::filesystem::exists(o.output))
    fail(ErrorKind::file, o.output, ": exists already; choose another name or add --force");
  Progress progress(common, o.thin > 0 ? 3 : 2);
  progress.step("reading and completing " + o.scene.path);
  LoadedScene loaded = load_scene(o.scene.path, load_options(common, o.scene));
  auto notes = loading_notes(loaded.report);
  if (o.thin > 0) {
    const std::size_t all = loaded.scene.size();
    progress.step(fmt::format("thinning {} surfels", all));
    loaded.scene = thin_scene(loaded.scene, o.thin);
    notes.push_back(fmt::format("thinned to {} m: {} of {} surfels stay, with the area of those that went", o.thin,
                                loaded.scene.size(), all));
  }
  for (const std::string& note : notes) progress.note(note);
  progress.step("writing " + o.output);
  if (is_tiles(o.output))
    save_tiles(o.output, loaded.scene);
  else
    save_scene(o.output, loaded.scene);

  const double area = std::accumulate(loaded.scene.area.begin(), loaded.scene.area.end(), 0.0);
  if (common.json) {
    const nlohmann::ordered_json result = {
        {"output", o.output}, {"points_read", loaded.report.points_read},          {"surfels", loaded.scene.size()},
        {"area_m2", area},    {"normals_oriented", loaded.scene.normals_oriented}, {"notes", notes}};
    fmt::print("{}\n", result.dump(2));
  } else {
    fmt::print("{}: {} surfels, {:.4g} m^2, normals {}\n", o.output, loaded.scene.size(), area,
               loaded.scene.normals_oriented ? "oriented" : "two-sided");
  }
}

}  // namespace insonify::tool
