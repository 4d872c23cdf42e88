// SPDX-License-Identifier: BSD-3-Clause
// Tests the soundings of a bathymetric echo sounder on known beds, and its predicted errors against its errors.
#include "returns/bottom_detection.hpp"
#include "simulate/simulate_ping.hpp"
#include "store/sonar_file.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace {

/// Returns a preset, straight down from the origin.
SonarHead swath_head(const std::string& name, double min_range, double max_range) {
  SonarSpec spec = find_sonar(name).spec;
  spec.min_range = min_range, spec.max_range = max_range;
  return make_head(spec, sound_speed(Water{}));
}

/// Adds surfels of 0.25 m along y from `begin` to `end`, on the line z = height(y) across the x axis.
void add_bed(SceneCloud& scene, double begin, double end, const Eigen::Vector3d& along, const Eigen::Vector3d& start) {
  const double s = 0.25;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitX().cross(along);
  for (double y = begin; y < end - 1e-9; y += s)
    for (int j = -8; j < 8; ++j)
      add_surfel(scene, start + (y + 0.5 * s) * along + (j + 0.5) * s * Eigen::Vector3d::UnitX(), up, s * s);
}

SimulatedPing ping_of(const SceneCloud& scene, const SonarHead& head, std::int64_t ping, bool noise) {
  SimulationOptions o;
  o.seed = 100 + static_cast<std::uint64_t>(ping);
  o.outputs.split_phase = true;
  o.effects.noise = noise;
  o.synthesis.tolerance = 1e-3;
  o.sampling.scatterers_per_cell = 3;
  const Pose down = pose_from_yaw_pitch_roll({0, 0, 0}, 0, pi / 2, 0);
  return simulate_event(scene, head, {.world_from_head = down, .number = ping}, {}, o);
}

BottomSoundings soundings_of(const SimulatedPing& result, const SonarHead& head, bool phase = true) {
  const double c = result.report.medium.sound_speed;
  return detect_bottom(result.ping, {.sound_speed = c,
                                     .centre_frequency = head.pulse.centre_frequency,
                                     .range_resolution = range_resolution(head.pulse, c),
                                     .absorption_db_per_m = result.report.medium.absorption.a0 / nepers_per_db,
                                     .phase = phase});
}

/// Returns the root mean square, over beams from `begin` on, of the ratio of deviations to predicted ones.
double ratio_of(const std::vector<BottomSoundings>& pings, std::size_t begin, std::size_t end) {
  const auto count = static_cast<double>(pings.size());
  double sum = 0;
  for (std::size_t b = begin; b < end; ++b) {
    // About the mean of the pings, each with its weight: a beam may change its method.
    double weights = 0, mean = 0;
    const auto weight = [&](const BottomSoundings& ping) {
      return 1 / std::pow(static_cast<double>(ping.deviation[b]), 2);
    };
    for (const BottomSoundings& ping : pings) weights += weight(ping), mean += weight(ping) * ping.range[b];
    mean /= weights;
    for (const BottomSoundings& ping : pings) sum += std::pow(ping.range[b] - mean, 2) * weight(ping) / (count - 1);
  }
  return std::sqrt(sum / static_cast<double>(end - begin));
}

/// Errors of a flat bed 20 m below, in equal parts of the fan.
struct FlatBed {
  std::vector<double> bias;       // mean error of depth [m]
  std::vector<double> ratio;      // ratio of deviations to predicted ones
  std::vector<double> by_phase;   // fraction of the soundings
  double by_phase_below = 0;      // fraction within a degree of straight down
  double ratio_of_amplitude = 0;  // the same for soundings without a phase, in the middle part
};

FlatBed measure_flat_bed(const std::string& sonar, double max_range) {
  const SonarHead head = swath_head(sonar, 18, max_range);
  SceneCloud scene;
  add_bed(scene, -60, 60, {0, 1, 0}, {0, 0, -20});
  constexpr std::size_t parts = 5;
  std::vector<BottomSoundings> found, by_amplitude;
  for (int p = 0; p < 8; ++p) {
    const SimulatedPing ping = ping_of(scene, head, p, true);
    found.push_back(soundings_of(ping, head));
    by_amplitude.push_back(soundings_of(ping, head, false));
    if (found.back().size() != head.fan.beams()) throw std::runtime_error("a beam has no sounding");
  }
  FlatBed bed;
  double below = 0;
  for (std::size_t k = 0; k < parts; ++k) {
    const std::size_t begin = (k * head.fan.beams() + parts - 1) / parts;
    const std::size_t end = ((k + 1) * head.fan.beams() + parts - 1) / parts;
    double bias = 0, by_phase = 0;
    for (std::size_t b = begin; b < end; ++b)
      for (const BottomSoundings& ping : found) {
        const bool phase = ping.method[b] == BottomMethod::phase;
        bias += ping.position[b].z() + 20, by_phase += phase;
        if (std::abs(head.fan.azimuth[b]) < radians(1)) below += 1, bed.by_phase_below += phase;
      }
    const auto soundings = static_cast<double>((end - begin) * found.size());
    bed.bias.push_back(bias / soundings), bed.by_phase.push_back(by_phase / soundings);
    bed.ratio.push_back(ratio_of(found, begin, end));
    if (k == parts / 2) bed.ratio_of_amplitude = ratio_of(by_amplitude, begin, end);
  }
  bed.by_phase_below /= below;
  return bed;
}

void expect_honest(const FlatBed& bed) {
  for (std::size_t k = 0; k < bed.bias.size(); ++k) {
    testing::Test::RecordProperty("bias_mm_" + std::to_string(k), std::to_string(1000 * bed.bias[k]));
    testing::Test::RecordProperty("ratio_" + std::to_string(k), std::to_string(bed.ratio[k]));
    EXPECT_LT(std::abs(bed.bias[k]), 0.001 * 20) << k;
    EXPECT_LT(bed.ratio[k], 1.3) << k;
    EXPECT_GT(bed.ratio[k], 1 / 1.3) << k;
  }
  testing::Test::RecordProperty("ratio_of_amplitude", std::to_string(bed.ratio_of_amplitude));
  EXPECT_LT(bed.ratio_of_amplitude, 1.3);
  EXPECT_GT(bed.ratio_of_amplitude, 1 / 1.3);
  // Amplitude where a pulse is longer than the footprint, phase elsewhere.
  EXPECT_GT(bed.by_phase.front(), 0.95);
  EXPECT_GT(bed.by_phase.back(), 0.95);
  EXPECT_GT(bed.by_phase[bed.by_phase.size() / 2], 0.5);
  EXPECT_LT(bed.by_phase_below, 0.1);
}

}  // namespace

// Bias below 0.1 % of the depth.
TEST(BathymetryLaws, flat_bed_of_an_r2sonic_2024) { expect_honest(measure_flat_bed("r2sonic-2024", 52)); }
TEST(BathymetryLaws, flat_bed_of_an_em2040) { expect_honest(measure_flat_bed("em2040", 64)); }

namespace {

/// Errors of the ranges of some soundings [m], from their distances to the surface on which they lie.
struct RegionErrors {
  std::string name;
  double count = 0, sum = 0, squares = 0, normalised = 0;
  void add(double distance, const Eigen::Vector3d& normal, const Eigen::Vector3d& position, float deviation) {
    const double off =
        distance / std::abs(normal.normalized().dot(position.normalized()));  // the head is at the origin
    count += 1, sum += off, squares += off * off;
    normalised += std::pow(off / static_cast<double>(deviation), 2);
  }
  /// Bias below 3 mm, errors over their predicted deviations within a factor 1.5 of 1 (root mean square).
  void expect_small(double least_count) const {
    ASSERT_GT(count, least_count) << name;
    const double bias = sum / count, deviation = std::sqrt(squares / count - bias * bias);
    const double ratio = std::sqrt(normalised / count);
    testing::Test::RecordProperty(name + "_bias_mm", std::to_string(1000 * bias));
    testing::Test::RecordProperty(name + "_deviation_mm", std::to_string(1000 * deviation));
    testing::Test::RecordProperty(name + "_ratio", std::to_string(ratio));
    EXPECT_LT(std::abs(bias), 3e-3) << name;
    EXPECT_LT(ratio, 1.5) << name;
    EXPECT_GT(ratio, 1 / 1.5) << name;
  }
};

}  // namespace

// z = -20 + y, from below the head upwards: seen from 20 degrees to starboard to port.
TEST(BathymetryLaws, slope_of_45_degrees) {
  const SonarHead head = swath_head("r2sonic-2024", 8, 40);
  SceneCloud scene;
  add_bed(scene, -20, 26, Eigen::Vector3d(0, 1, 1).normalized(), {0, 0, -20});
  const BottomSoundings found = soundings_of(ping_of(scene, head, 0, true), head);
  RegionErrors below{"slope_below"}, beside{"slope_beside"};
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found.position[i].y() < -6) continue;  // beyond, the beams run along the slope
    const double off = (found.position[i].z() + 20 - found.position[i].y()) / std::sqrt(2.0);
    EXPECT_LT(std::abs(off), 0.1) << found.beam[i];
    (found.position[i].y() < 5 ? below : beside).add(off, {0, -1, 1}, found.position[i], found.deviation[i]);
  }
  below.expect_small(60);
  beside.expect_small(60);
}

// A vertical step of 1 m at y = 8 m, 20 m below on the near side: both levels and the face between them are found, and
// no sounding stands off them by more than a beam.
TEST(BathymetryLaws, step_of_one_metre) {
  const SonarHead head = swath_head("r2sonic-2024", 17, 40);
  SceneCloud scene;
  add_bed(scene, -10, 8, {0, 1, 0}, {0, 0, -20});
  add_bed(scene, 0, 1, {0, 0, 1}, {0, 8, -20});
  add_bed(scene, 8, 26, {0, 1, 0}, {0, 0, -19});
  const BottomSoundings found = soundings_of(ping_of(scene, head, 0, true), head);
  int low = 0, high = 0, face = 0;
  RegionErrors bed{"before_step"}, top{"behind_step"};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Eigen::Vector3d& p = found.position[i];
    if (p.y() < -8 || p.y() > 20) continue;
    if (p.y() < 7.5) bed.add(p.z() + 20, {0, 0, 1}, p, found.deviation[i]);
    if (p.y() > 8.5) top.add(p.z() + 19, {0, 0, 1}, p, found.deviation[i]);
    if (std::abs(p.z() + 20) < 0.03) ++low;
    if (std::abs(p.z() + 19) < 0.03) ++high;
    if (std::abs(p.y() - 8) < 0.03 && p.z() > -19.95 && p.z() < -19.05) ++face;
    const double off =
        std::min({std::hypot(std::max(0.0, p.y() - 8), p.z() + 20), std::hypot(std::min(0.0, p.y() - 8), p.z() + 19),
                  std::hypot(p.y() - 8, std::max({0.0, p.z() + 19, -20 - p.z()}))});
    EXPECT_LT(off, 0.2) << found.beam[i] << ": " << p.transpose();
  }
  EXPECT_GT(low, 80);
  EXPECT_GT(high, 40);
  EXPECT_GE(face, 1);
  bed.expect_small(80);
  top.expect_small(40);
}
