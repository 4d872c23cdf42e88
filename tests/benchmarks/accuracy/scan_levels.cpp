// Levels of the whole ping of a height field that was captured as points on a square grid, against sums over the
// triangles between them:
//
//   scan_levels CLOUD SONAR_FILE X Y Z YAW PITCH MIN_RANGE MAX_RANGE      (metres, degrees)
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <string>

#include "core/units.hpp"
#include "scene_io/load_scene.hpp"
#include "simulate/simulate_ping.hpp"
#include "store/sonar_file.hpp"
#include "support/height_field.hpp"
#include "support/scene_for_ping.hpp"

using namespace insonify;

namespace {

HeightField field_of(const SceneCloud& scene) {
  const Bounds box = bounds(scene);
  const Eigen::Vector3d size = box.max - box.min;
  HeightField field;
  field.corner = box.min.head<2>();
  // Nodes fill the box, unless some are missing.
  field.spacing = (std::sqrt(size.x() * size.y() * static_cast<double>(scene.size())) + (size.x() + size.y()) / 2) /
                  static_cast<double>(scene.size());
  const auto nodes = [&](double length) { return static_cast<Eigen::Index>(std::lround(length / field.spacing)) + 1; };
  field.spacing = size.x() / static_cast<double>(nodes(size.x()) - 1);
  field.z = Grid<double>::Constant(nodes(size.y()), nodes(size.x()), std::numeric_limits<double>::quiet_NaN());
  for (const Eigen::Vector3f& point : scene.point) {
    const Eigen::Vector3d p = scene.origin + point.cast<double>();
    const Eigen::Vector2d at = (p.head<2>() - field.corner) / field.spacing;
    field.z(std::lround(at.y()), std::lround(at.x())) = p.z();
  }
  std::printf("%ld x %ld nodes, %.4f m apart, %ld without a point\n", static_cast<long>(field.z.rows()),
              static_cast<long>(field.z.cols()), field.spacing, static_cast<long>(field.z.isNaN().count()));
  return field;
}

void run(char** argv) {
  LoadOptions load;
  load.viewpoint = Eigen::Vector3d(std::stod(argv[3]), std::stod(argv[4]), 1000);
  const LoadedScene loaded = load_scene(argv[1], load);
  const SceneCloud& scene = loaded.scene;
  const Medium medium = medium_of(Water{}, 750e3);
  SonarSpec sonar = find_sonar(argv[2]).spec;
  sonar.min_range = std::stod(argv[8]);
  sonar.max_range = std::stod(argv[9]);
  const SonarHead head = make_head(sonar, medium.sound_speed);
  const Pose pose = pose_from_yaw_pitch_roll({std::stod(argv[3]), std::stod(argv[4]), std::stod(argv[5])},
                                             radians(std::stod(argv[6])), radians(std::stod(argv[7])), 0);
  const Eigen::Index groups = 8, bands = 8;
  const Grid<double> truth = energy_by_definition(field_of(scene), scene.materials.front().lambert_mu, head, pose,
                                                  medium_of(Water{}, head.pulse.centre_frequency), 2, groups, bands);
  SimulationOptions options;
  options.synthesis.method = SynthesisMethod::incoherent;
  const Grid<double> energy = energy_of(
      simulate_ping(scene_for_ping(loaded, head, pose, options), head, pose, {}, options).ping.pressure, groups, bands);

  const auto error = [](double a, double b) { return b > 0 ? db_from_power(a / b) : 0; };
  std::printf("error of the total %+.2f dB\nof bands of range, near to far [dB]:", error(energy.sum(), truth.sum()));
  for (Eigen::Index n = 0; n < bands; ++n) std::printf(" %+.2f", error(energy.col(n).sum(), truth.col(n).sum()));
  std::printf("\nof groups of beams (rows) in bands of range; . is 30 dB below the strongest\n");
  for (Eigen::Index g = 0; g < groups; ++g, std::printf("\n"))
    for (Eigen::Index n = 0; n < bands; ++n)
      if (truth(g, n) > 1e-3 * truth.maxCoeff())
        std::printf(" %+6.2f", error(energy(g, n), truth(g, n)));
      else
        std::printf("      .");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 10) {
    std::fprintf(stderr, "usage: scan_levels CLOUD SONAR_FILE X Y Z YAW PITCH MIN_RANGE MAX_RANGE\n");
    return 2;
  }
  try {
    run(argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scan_levels: %s\n", error.what());
    return 1;
  }
  return 0;
}
