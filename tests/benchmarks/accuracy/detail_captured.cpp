// SPDX-License-Identifier: BSD-3-Clause
// Error of levels of detail (E137) in captured scenes, as a table in Markdown (docs/results/detail.md):
//   detail_captured FOLDER   (of office1.pcd, car6.pcd, coral_mcap_vn.obj, records/ship_3dsonar_frame5.pcd)
//
// Expected levels with nodes of one beam against those of all surfels, from several places.
#include <cstdio>
#include <string>

#include "../compared_levels.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "scene_io/load_scene.hpp"
#include "simulate/ping_simulator.hpp"
#include "store/sonar_file.hpp"

namespace {

using namespace insonify;

/// A file with the pose of a head of a p900-45 with 512 beams in it; ranges in metres, angles in degrees.
struct CapturedView {
  const char *what, *file;
  Eigen::Vector3d position, angles;
  double min_range, max_range;
  double mesh_spacing = 0;  ///< spacing of a mesh that is taken as a cloud [m]
  bool from_head = false;   ///< true: the file has no viewpoint, it was captured from about the head's position
};

const CapturedView views[] = {
    {"room (office1), from the camera", "office1.pcd", {0, 0, 0}, {90, -90, 0}, 1, 6},
    {"room, turned by 10 degrees", "office1.pcd", {0, 0, 0}, {90, -80, 0}, 1, 6},
    {"room, from 0.8 m beside the camera", "office1.pcd", {0.8, 0, 0}, {90, -90, 0}, 1, 6},
    {"room, from 1.8 m beside the camera", "office1.pcd", {1.8, 0, 0}, {90, -90, 0}, 1, 6},
    {"street: two cars by a lidar (car6)", "car6.pcd", {-37, -76, -5}, {90, 5, 0}, 2, 16, 0, true},
    {"coral colony, mesh as a cloud of 1 mm", "coral_mcap_vn.obj", {-2.2, 0.94, -3.3}, {0, 18, 0}, 0.5, 1.4, 1e-3},
    {"wall and hull, a frame of a 3-D sonar", "records/ship_3dsonar_frame5.pcd", {0, 0, 0}, {0, 0, 0}, 1, 15, 0, true}};

SceneCloud cloud_of(const CapturedView& view, const std::string& folder) {
  LoadOptions options;
  options.mesh_spacing = view.mesh_spacing;
  if (view.from_head) options.viewpoint = view.position;
  return load_scene(folder + "/" + view.file, options).scene;
}

Grid<double> levels_of(const PreparedScene& scene, const CapturedView& view, double width) {
  SonarSpec spec = find_sonar("p900-45").spec;
  spec.beams = 512, spec.min_range = view.min_range, spec.max_range = view.max_range;
  const SonarHead head = make_head(spec, sound_speed(Water{}));
  const Pose pose = pose_from_yaw_pitch_roll(view.position, radians(view.angles.x()), radians(view.angles.y()),
                                             radians(view.angles.z()));
  const SimulationOptions options{.sampling = {.detail_width = width},
                                  .synthesis = {.method = SynthesisMethod::incoherent}};
  return PingSimulator(head, {}, options).ping(scene, {pose}).ping.pressure.abs2().cast<double>();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "detail_captured FOLDER\n"), 2;
  try {
    std::printf(
        "\n| scene | surfels | rms of cells [dB] | cells off by 10 dB [%%] | total [dB] | worst band [dB] "
        "|\n|---|---|---|---|---|---|\n");
    std::string loaded;
    PreparedScene scene{SceneCloud{}};
    for (const CapturedView& view : views) {
      if (loaded != view.file) scene = PreparedScene(cloud_of(view, argv[1])), loaded = view.file;
      const Grid<double> exact = levels_of(scene, view, 0), level = levels_of(scene, view, 1);
      const auto [cells, far] = difference(level, exact);
      std::printf("| %s | %zu | %.2f | %.3f | %+.3f | %+.2f |\n", view.what, scene.scene().size(), cells, 100 * far,
                  db_from_power(level.sum() / exact.sum()), worst_band(level, exact));
      std::fflush(stdout);
    }
    std::printf("\n");
  } catch (const Error& error) {
    return std::fprintf(stderr, "detail_captured: %s\n", error.what()), 1;
  }
}
