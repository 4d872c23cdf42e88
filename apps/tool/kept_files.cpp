#include "tool/kept_files.hpp"

#include <algorithm>

#include "returns/insonification.hpp"
#include "scene_io/save_cloud.hpp"
#include "store/contributor_file.hpp"
#include "view/save_vtk.hpp"

namespace insonify::tool {

using nlohmann::ordered_json;

namespace {

ordered_json write_contributors(const RunDirectory& directory, const SceneCloud& scene, const Contributors& found) {
  NamedContributors named{found, {}};
  for (const Material& material : scene.materials) named.materials.push_back(material.name);
  write_contributor_file(directory.file("contributors.h5"), named);
  std::size_t pixels = 0;
  double share = 0;
  for (std::size_t i = 0; i < found.share.size(); ++i) {
    pixels += i % found.per_pixel == 0 && found.share[i] > 0;
    share += static_cast<double>(found.share[i]);
  }
  return {{"per_pixel", found.per_pixel},
          {"pixels", pixels},
          {"mean_share_listed", pixels > 0 ? share / static_cast<double>(pixels) : 0}};
}

ordered_json write_insonification(const RunDirectory& directory, const SceneCloud& scene, const PingSetup& setup,
                                  const SimulatedPing& ping) {
  Insonification map;
  InsonificationOptions options;
  options.threads = setup.simulation.threads;
  add_ping(map, scene, ping.scatterers, setup.head.head, ping.medium, options);
  save_insonification(directory.file("insonification.ply"), scene, map);
  save_insonification(directory.file("insonification.pcd"), scene, map);
  const auto heard = map.size() - static_cast<std::size_t>(std::count(map.hits.begin(), map.hits.end(), 0U));
  return {{"surfels", map.size()}, {"heard", heard}};
}

ordered_json write_paths(const RunDirectory& directory, const SoundPaths& paths) {
  LineSet lines{paths.points, {{"level_db", paths.level_db}, {"bounces", {}}}};
  lines.fields[1].values.assign(paths.bounces.begin(), paths.bounces.end());
  save_lines(directory.file("paths.vtp"), lines);
  return {{"lines", paths.size()}};
}

}  // namespace

void write_kept(const RunDirectory& directory, const PingOptions& options, const SceneCloud& scene,
                const PingSetup& setup, const SimulatedPing& ping, ordered_json& manifest) {
  if (setup.simulation.outputs.contributors > 0)
    manifest["contributors"] = write_contributors(directory, scene, ping.contributors);
  if (setup.simulation.outputs.paths > 0) manifest["paths"] = write_paths(directory, ping.paths);
  if (keeps(options, "insonification"))
    manifest["insonification"] = write_insonification(directory, scene, setup, ping);
}

}  // namespace insonify::tool
