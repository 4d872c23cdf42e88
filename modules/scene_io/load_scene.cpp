#include "scene_io/load_scene.hpp"

#include "scene_io/complete_scene_internal.hpp"
#include "scene_io/file_probe_internal.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/tiled_scene.hpp"

namespace insonify {

ReadOptions read_options(const LoadOptions& options) {
  return {options.unit, options.threads, options.material ? MaterialField{} : options.material_field};
}

namespace {

/// All of a .tiles file, which is complete.
LoadedScene load_all_tiles(const std::string& path, const LoadOptions& options) {
  const TiledScene tiled(path);
  LoadedScene loaded{tiled.load(tiled.select_all(), 0, options.threads), {}};
  loaded.scene.part_of.reset();
  loaded.report.path = path;
  loaded.report.format = "insonify tiles";
  loaded.report.points_read = loaded.scene.size();
  loaded.report.materials_found = true;
  return loaded;
}

}  // namespace

LoadedScene load_scene(const std::string& path, const LoadOptions& options) {
  check_options(options, "load_scene");
  if (extension_of(path) == ".tiles") return load_all_tiles(path, options);
  return complete_scene(read_any(path, read_options(options)), options);
}

}  // namespace insonify
