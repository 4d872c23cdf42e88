#include "scene_io/load_scene.hpp"

#include "scene_io/complete_scene_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"
#include "scene_io/tiled_scene.hpp"

namespace insonify {

ReadOptions read_options(const LoadOptions& options) {
  return {options.unit, options.threads, options.material ? MaterialField{} : options.material_field};
}

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

LoadedScene load_scene(const std::string& path, const LoadOptions& options) {
  check_options(options, "load_scene");
  const SceneReader& reader = reader_of(path);
  if (reader.load) return reader.load(path, options);
  return complete_scene(reader.read(path, read_options(options)), options);
}

}  // namespace insonify
