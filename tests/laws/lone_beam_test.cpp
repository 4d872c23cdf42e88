// SPDX-License-Identifier: BSD-3-Clause
// Tests the deviations of soundings of echo sounders, whose only beam has no neighbours, against their errors.
#include <optional>

#include "acoustics/noise.hpp"
#include "core/parallel.hpp"
#include "returns/bottom_detection.hpp"
#include "simulate/ping_simulator.hpp"
#include "store/sonar_file.hpp"
#include "support/test.hpp"

namespace {

constexpr int soundings_of_a_bed = 250;

/// A bed about the plane z = x tan(slope), with waves of relief that are shorter than a footprint.
struct SounderBed {
  double slope_deg = 0;
  double relief = 0;     ///< root mean square altitude [m]
  double reach = 0;      ///< half the side [m]
  double spacing = 0.1;  ///< spacing of surfels [m]
};

struct ReliefWave {
  double along, across, phase;
};

std::vector<ReliefWave> relief_waves() {
  std::mt19937 draw(5);
  std::uniform_real_distribution<double> length(0.5, 0.9), turn(0, 2 * pi);
  std::vector<ReliefWave> waves(12);
  for (ReliefWave& w : waves) {
    const double k = 2 * pi / length(draw), angle = turn(draw);
    w = {k * std::cos(angle), k * std::sin(angle), turn(draw)};
  }
  return waves;
}

SceneCloud scene_of(const SounderBed& bed) {
  const std::vector<ReliefWave> waves = relief_waves();
  const double altitude = bed.relief * std::sqrt(2.0 / static_cast<double>(waves.size()));
  SceneCloud scene;
  for (double x = -bed.reach; x < bed.reach; x += bed.spacing)
    for (double y = -bed.reach; y < bed.reach; y += bed.spacing) {
      double z = x * std::tan(radians(bed.slope_deg)), dx = std::tan(radians(bed.slope_deg)), dy = 0;
      for (const ReliefWave& w : waves) {
        const double phase = w.along * x + w.across * y + w.phase;
        z += altitude * std::cos(phase);
        dx -= altitude * w.along * std::sin(phase), dy -= altitude * w.across * std::sin(phase);
      }
      const Eigen::Vector3d up(-dx, -dy, 1);
      add_surfel(scene, {x, y, z}, up.normalized(), bed.spacing * bed.spacing * up.norm());
    }
  return scene;
}

/// Errors of an echo sounder at an altitude above the plane of a bed, rolled and pitched by up to five degrees.
struct SounderErrors {
  double bias = 0, observed = 0, predicted = 0, normalised = 0;
  double altitude = 0;  ///< altitude of the head [m]
  int found = 0;
};

struct SoundingError {
  double error, deviation;  // [m]
};

/// Returns the error of a ping; nothing if no sounding is kept.
std::optional<SoundingError> error_of_ping(const PingSimulator& sounder, const PreparedScene& scene,
                                           const SounderBed& bed, double altitude, std::size_t number) {
  std::mt19937 draw(static_cast<unsigned>(number) + 7);
  std::uniform_real_distribution<double> position(-1, 1), tilt(radians(-5), radians(5)), heading(0, 2 * pi);
  const double x = position(draw), y = position(draw), slope = std::tan(radians(bed.slope_deg));
  const Eigen::Vector3d at(x, y, x * slope + altitude), up(-slope, 0, 1);
  const Pose pose = pose_from_yaw_pitch_roll(at, heading(draw), pi / 2 + tilt(draw), tilt(draw));
  SimulationOptions o = sounder.options();
  o.seed = number;
  const SimulatedPing result =
      sounder.with(o).ping(scene, {.world_from_head = pose, .number = static_cast<std::int64_t>(number)});
  const double c = result.report.medium.sound_speed;
  const BottomSoundings found =
      detect_bottom(result.ping, {.sound_speed = c,
                                  .centre_frequency = sounder.head().pulse.centre_frequency,
                                  .range_resolution = range_resolution(sounder.head().pulse, c),
                                  .absorption_db_per_m = result.report.medium.absorption.a0 / nepers_per_db,
                                  .threads = 1});
  if (found.size() != 1 || found.reject[0] != 0) return {};
  const double truth = -up.dot(at) / up.dot(pose.linear().col(0));
  return SoundingError{found.range[0] - truth, static_cast<double>(found.deviation[0])};
}

SounderErrors sum_of(const std::vector<std::optional<SoundingError>>& errors) {
  SounderErrors all;
  double squares = 0;
  for (const auto& each : errors) {
    if (!each) continue;
    ++all.found, all.bias += each->error, squares += each->error * each->error;
    all.predicted += each->deviation * each->deviation, all.normalised += std::pow(each->error / each->deviation, 2);
  }
  all.bias /= all.found, all.predicted = std::sqrt(all.predicted / all.found);
  all.observed = std::sqrt(squares / all.found - all.bias * all.bias);
  all.normalised = std::sqrt(all.normalised / all.found);
  return all;
}

SounderErrors errors_of(const std::string& sonar, double altitude, const SounderBed& bed) {
  SonarSpec spec = find_sonar(sonar).spec;
  spec.min_range = 0.3 * altitude, spec.max_range = 2 * altitude;
  const SceneCloud scene = scene_of(bed);
  const PreparedScene prepared(scene, 0);
  SimulationOptions o;
  o.effects.noise = true;
  o.sampling.scatterers_per_cell = 3;
  o.threads = 1;  // pings are side by side
  const PingSimulator sounder(make_head(spec, sound_speed(Water{})), {}, o);
  std::vector<std::optional<SoundingError>> errors(soundings_of_a_bed);
  parallel_for(errors.size(), 0,
               [&](std::size_t p) { errors[p] = error_of_ping(sounder, prepared, bed, altitude, p); });
  SounderErrors all = sum_of(errors);
  all.altitude = altitude;
  return all;
}

void expect_errors_as_predicted(const std::string& name, const SounderErrors& errors) {
  const auto record = [&](const char* what, double value) {
    testing::Test::RecordProperty(name + what, std::to_string(value));
    std::printf("  %s%s %.4g", name.c_str(), what, value);
  };
  record("_bias_mm", 1000 * errors.bias), record("_observed_mm", 1000 * errors.observed);
  record("_predicted_mm", 1000 * errors.predicted), record("_normalised", errors.normalised);
  std::printf("\n");
  EXPECT_GT(errors.found, 0.995 * soundings_of_a_bed) << name;
  EXPECT_LT(errors.observed, 1.2 * errors.predicted) << name;
  EXPECT_GT(errors.observed, 0.8 * errors.predicted) << name;
  EXPECT_LT(errors.normalised, 1.25) << name;
  EXPECT_GT(errors.normalised, 0.8) << name;
  EXPECT_LT(std::abs(errors.bias), 0.0025 * errors.altitude) << name;
}

}  // namespace

TEST(EchoSounder, deviations_of_an_es200_are_its_errors) {
  expect_errors_as_predicted("flat", errors_of("es200-7c", 12, {0, 0, 7, 0.2}));
  expect_errors_as_predicted("sloping", errors_of("es200-7c", 12, {12, 0, 7, 0.2}));
  expect_errors_as_predicted("rough", errors_of("es200-7c", 20, {0, 0.05, 10, 0.1}));
}

TEST(EchoSounder, deviations_of_a_ping2_are_its_errors) {
  expect_errors_as_predicted("flat", errors_of("ping2", 7, {0, 0, 12, 0.2}));
  expect_errors_as_predicted("sloping", errors_of("ping2", 7, {12, 0, 12, 0.2}));
  expect_errors_as_predicted("rough", errors_of("ping2", 5, {0, 0.05, 9, 0.1}));
}

// The floor of soundings against the noise that the head itself has in a beam.
TEST(ThermalFloor, is_that_of_the_beams_of_all_presets_of_several_beams) {
  std::size_t heads = 0;
  double worst = 0;
  for (const SonarFile& sonar : list_sonars()) {
    if (beams_of(sonar.spec) < 2) continue;
    const SonarHead head = make_head(sonar.spec, sound_speed(Water{}));
    const double off =
        thermal_floor_db(head.pulse, head.fan) - (thermal_noise_level_db(head.pulse) - array_gain_db(head));
    ++heads, worst = std::max(worst, std::abs(off));
    EXPECT_LT(std::abs(off), 2) << sonar.spec.name;
  }
  RecordProperty("worst_db", std::to_string(worst));
  std::printf("  worst_db %.3g of %zu heads\n", worst, heads);
  EXPECT_GT(heads, 30U);
}
