#include "scene/built_in_scenes.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "scene/harbour_scene_internal.hpp"
#include "scene/sample_patches_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

std::vector<Patch> plane_patches(const BuiltInSceneOptions& options) {
  const double x = options.size.x(), y = options.size.y();
  return {rectangle({0, -y / 2, 0}, {x, 0, 0}, {0, y, 0})};
}

std::vector<Patch> sphere_patches(const BuiltInSceneOptions& options) {
  return {ellipsoid({5, 0, 0}, Vector3d::Constant(options.radius))};
}

// Rectangle in the plane x = const with its normal towards the head: y from low to high, z from bottom to top.
Patch facing_wall(double x, double low, double high, double bottom, double top) {
  return rectangle({x, low, bottom}, {0, 0, top - bottom}, {0, high - low, 0});
}

std::vector<Patch> wall_patches(const BuiltInSceneOptions& options) {
  const double w = options.size.x() / 2, h = options.size.y() / 2, hole = 0.5;
  if (w <= 2 * hole || h <= 2 * hole) return {facing_wall(5, -w, w, -h, h)};
  return {facing_wall(5, -w, w, -h, -hole), facing_wall(5, -w, w, hole, h), facing_wall(5, -w, -hole, -hole, hole),
          facing_wall(5, hole, w, -hole, hole)};
}

std::vector<Patch> pole_patches() {
  std::vector<Patch> patches = {facing_wall(7, -3, 3, -2, 2)};
  for (const double y : {-1.0, 0.0, 1.0}) patches.push_back(cylinder({4, y, -2}, {0, 0, 4}, 0.1));
  return patches;
}

void require_valid(const std::string& name, const BuiltInSceneOptions& options) {
  const std::vector<std::string> names = built_in_scene_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    std::string known;
    for (const std::string& n : names) known += (known.empty() ? "" : ", ") + n;
    fail(ErrorKind::argument, "make_built_in_scene: no scene '", name, "', must be one of: ", known);
  }
  if (options.points == 0) fail(ErrorKind::argument, "make_built_in_scene: points = 0, must be at least 1");
  if (!(options.size.minCoeff() > 0) || !options.size.allFinite())
    fail(ErrorKind::argument, "make_built_in_scene: size = ", options.size.x(), " x ", options.size.y(),
         " m, must be positive");
  if (!(options.radius > 0) || !std::isfinite(options.radius))
    fail(ErrorKind::argument, "make_built_in_scene: radius = ", options.radius, " m, must be positive");
}

std::vector<Patch> patches_of(const std::string& name, const BuiltInSceneOptions& options) {
  if (name == "harbour") return harbour_patches(options.seed);
  if (name == "plane") return plane_patches(options);
  if (name == "sphere") return sphere_patches(options);
  if (name == "wall") return wall_patches(options);
  return pole_patches();
}

}  // namespace

std::vector<std::string> built_in_scene_names() { return {"harbour", "plane", "sphere", "wall", "poles"}; }

SceneCloud empty_built_in_scene(const std::string& name, const BuiltInSceneOptions& options) {
  require_valid(name, options);
  SceneCloud scene;
  scene.materials = name == "harbour" ? harbour_materials() : std::vector<Material>{{name, options.lambert_mu}};
  return scene;
}

SceneCloud make_built_in_scene(const std::string& name, const BuiltInSceneOptions& options) {
  SceneCloud scene = empty_built_in_scene(name, options);
  sample_patches(scene, patches_of(name, options), options.points, options.seed);
  return scene;
}

void make_built_in_scene_in_batches(const std::string& name, const BuiltInSceneOptions& options, std::size_t batch,
                                    const std::function<void(const SceneCloud&)>& consume) {
  const SceneCloud like = empty_built_in_scene(name, options);
  sample_patches_in_batches(like, patches_of(name, options), options.points, options.seed, batch, consume);
}

}  // namespace insonify
