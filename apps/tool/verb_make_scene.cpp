#include <filesystem>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/units.hpp"
#include "scene/built_in_scenes.hpp"
#include "scene_io/save_cloud.hpp"
#include "tool/parse_values.hpp"
#include "tool/progress.hpp"
#include "tool/tiled_scenes.hpp"
#include "tool/verbs.hpp"

namespace insonify::tool {

void make_scene(const CommonOptions& common, const MakeSceneOptions& o) {
  if (is_tiles(o.output)) return make_scene_as_tiles(common, o);
  if (!o.force && std::filesystem::exists(o.output))
    fail(ErrorKind::file, o.output, ": exists already; choose another name or add --force");
  const auto size = parse_numbers("--size", o.size, 2, "two lengths in metres, e.g. --size 40,40");
  Progress progress(common, 2);
  progress.step("making " + o.name);
  const SceneCloud scene = make_built_in_scene(
      o.name, {o.points, {size[0], size[1]}, o.radius, power_from_db(o.lambert_mu_db), common.seed});
  progress.step("writing " + o.output);
  save_scene(o.output, scene);
  fmt::print("{}: {} surfels, {} materials\n", o.output, scene.size(), scene.materials.size());
}

}  // namespace insonify::tool
