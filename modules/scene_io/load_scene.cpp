#include "scene_io/load_scene.hpp"

#include "scene_io/complete_scene.hpp"
#include "scene_io/raw_cloud.hpp"

namespace insonify {

ReadOptions read_options(const LoadOptions& options) {
  return {options.unit, options.threads, options.material ? MaterialField{} : options.material_field};
}

LoadedScene load_scene(const std::string& path, const LoadOptions& options) {
  check_options(options, "load_scene");
  return complete_scene(read_any(path, read_options(options)), options);
}

}  // namespace insonify
