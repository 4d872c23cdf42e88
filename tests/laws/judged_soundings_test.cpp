// SPDX-License-Identifier: BSD-3-Clause
// Tests which soundings are rejected, and the deviations of the others against their errors, over beds with a known
// surface: the built-in river with its edges and gaps, reef and plane, and single targets on sand.
#include "returns/bottom_detection.hpp"
#include "scene/built_in_scenes.hpp"
#include "scene/scene_index.hpp"
#include "simulate/simulate_ping.hpp"
#include "store/sonar_file.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace {

constexpr double wrong_beyond = 0.5;  // [m] from the surface

SonarHead head_below(const std::string& name, double max_range) {
  SonarSpec spec = find_sonar(name).spec;
  spec.max_range = max_range;
  return make_head(spec, sound_speed(Water{}));
}

BottomSoundings soundings_below(const SceneCloud& scene, const SonarHead& head, const Eigen::Vector3d& at,
                                std::int64_t number) {
  SimulationOptions o;
  o.seed = 3;
  o.outputs.split_phase = true;
  o.effects.noise = true;
  const PingEvent event{.world_from_head = pose_from_yaw_pitch_roll(at, 0, pi / 2, 0), .number = number};
  const SimulatedPing result = simulate_event(scene, head, event, {}, o);
  const double c = result.report.medium.sound_speed;
  return detect_bottom(result.ping, {.sound_speed = c,
                                     .centre_frequency = head.pulse.centre_frequency,
                                     .range_resolution = range_resolution(head.pulse, c),
                                     .absorption_db_per_m = result.report.medium.absorption.a0 / nepers_per_db});
}

/// The surface of a scene, from surfels a few centimetres apart.
class Surface {
 public:
  explicit Surface(const SceneCloud& scene) : scene_(scene), index_(scene.point) {}
  double distance(const Eigen::Vector3d& position) const { return (position - nearest(position).first).norm(); }
  /// Returns the distance along a beam from `head` by which a position lies off the surface: off the plane of the nearest
  /// surfel, or off the surfel if that is farther away than surfels stand apart.
  double range_error(const Eigen::Vector3d& position, const Eigen::Vector3d& head) const {
    const auto [point, normal] = nearest(position);
    const double away = (position - point).norm();
    const double off =
        std::abs(normal.dot(position - point)) / std::max(0.17, std::abs(normal.dot((position - head).normalized())));
    return away > spacing ? std::max(off, away) : off;
  }

 private:
  static constexpr double spacing = 0.08;
  std::pair<Eigen::Vector3d, Eigen::Vector3d> nearest(const Eigen::Vector3d& position) const {
    std::vector<Neighbour> found;
    index_.find_nearest((position - scene_.origin).cast<float>(), 1, found);
    const std::size_t i = found.at(0).index;
    return {scene_.origin + scene_.point[i].cast<double>(), scene_.normal[i].cast<double>()};
  }
  const SceneCloud& scene_;
  SceneIndex index_;
};

/// Counts of soundings, and their errors over their deviations.
struct Judged {
  double found = 0, rejected = 0, wrong = 0, wrong_kept = 0, right = 0, right_rejected = 0;
  double right_sure = 0, wrong_sure = 0;  ///< kept soundings with deviations up to 0.25 m
  double right_in_lobes = 0;              ///< rejected soundings
  std::vector<double> normalised;
  double share_within(double deviations) const {
    const auto within = std::count_if(normalised.begin(), normalised.end(), [&](double e) { return e < deviations; });
    return static_cast<double>(within) / static_cast<double>(normalised.size());
  }
  /// Returns the root mean square; errors beyond five deviations, which edges have, count as five.
  double ratio() const {
    double sum = 0;
    for (const double e : normalised) sum += std::pow(std::min(e, 5.0), 2);
    return std::sqrt(sum / static_cast<double>(normalised.size()));
  }
};

/// Judges pings along the x axis from `start` on, `step` apart.
Judged judged(const SceneCloud& scene, const Surface& surface, const SonarHead& head, const Eigen::Vector3d& start,
              double step, int pings) {
  Judged all;
  for (int p = 0; p < pings; ++p) {
    const Eigen::Vector3d at = start + step * p * Eigen::Vector3d::UnitX();
    const BottomSoundings found = soundings_below(scene, head, at, p);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double away = surface.distance(found.position[i]);
      const bool kept = found.reject[i] == 0, wrong = away > wrong_beyond;
      const bool right = away < std::max(0.1, found.range[i] * head.fan.beam_width);
      all.found += 1, all.rejected += !kept;
      all.wrong += wrong, all.wrong_kept += wrong && kept;
      all.right += right, all.right_rejected += right && !kept;
      const bool in_lobe = (found.reject[i] & reject_grating_lobe) != 0;
      all.right_in_lobes += right && in_lobe;
      const bool sure = kept && found.deviation[i] <= 0.25F;
      all.right_sure += right && sure, all.wrong_sure += wrong && sure;
      if (kept && !wrong)
        all.normalised.push_back(surface.range_error(found.position[i], at) / static_cast<double>(found.deviation[i]));
    }
  }
  const auto record = [](const char* name, double value) {
    testing::Test::RecordProperty(name, std::to_string(value));
    std::printf("  %s %.4g", name, value);
  };
  record("found", all.found), record("rejected", all.rejected), record("wrong", all.wrong);
  record("wrong_kept", all.wrong_kept), record("right", all.right), record("right_rejected", all.right_rejected);
  record("right_sure", all.right_sure), record("wrong_sure", all.wrong_sure);
  record("ratio", all.ratio()), record("within_1", all.share_within(1)), record("within_2", all.share_within(2));
  std::printf("\n");
  return all;
}

Judged judged(const SceneCloud& scene, const SonarHead& head, const Eigen::Vector3d& start, double step, int pings) {
  return judged(scene, Surface(scene), head, start, step, pings);
}

void expect_trusted(const Judged& j) {
  EXPECT_LT(j.wrong_kept, 0.001 * (j.found - j.rejected));
  EXPECT_LT(j.right_rejected, 0.01 * j.right);
  EXPECT_GT(j.ratio(), 0.8);
  EXPECT_LT(j.ratio(), 1.3);
}

const SceneCloud& river() {
  static const SceneCloud scene = make_built_in_scene("river", {.points = 200000});
  return scene;
}

}  // namespace

TEST(JudgedSoundings, of_a_river_bed_with_gaps_by_an_em2040) {
  const Judged j = judged(river(), head_below("em2040", 14), {6, 0, -0.5}, 3.7, 7);
  expect_trusted(j);
  EXPECT_GT(j.wrong, 0.02 * j.found);  // beyond the edges, where side lobes and skirts are all that is received
}
TEST(JudgedSoundings, of_a_river_bed_with_gaps_by_an_r2sonic_2024) {
  expect_trusted(judged(river(), head_below("r2sonic-2024", 14), {6, 0, -0.5}, 3.7, 6));
}
// Beams are 20 degrees long along track. An echo from a boulder ahead arrives before that of the bed below, and no ping
// can distinguish it from a boulder below the head. Wrong soundings are marked as such.
TEST(JudgedSoundings, of_a_river_bed_by_an_oculus_m750d_that_looks_down) {
  SonarSpec spec = find_sonar("oculus-m750d").spec;
  spec.beams = 256, spec.max_range = 11;
  const Judged j = judged(river(), make_head(spec, sound_speed(Water{})), {8, 0, -0.5}, 3, 7);
  EXPECT_LT(j.wrong_kept, 0.01 * (j.found - j.rejected));
  EXPECT_EQ(j.wrong_sure, 0);
  EXPECT_GT(j.right_sure, 0.8 * j.right);
  EXPECT_LT(j.right_rejected, 0.01 * j.right);
  EXPECT_GT(j.ratio(), 0.8);
  EXPECT_LT(j.ratio(), 1.3);
}
TEST(JudgedSoundings, of_a_reef) {
  const SceneCloud reef = make_built_in_scene("reef", {.points = 200000});
  expect_trusted(judged(reef, head_below("em2040", 9), {3, 0, -0.5}, 1.3, 5));
}
// A quay lies to port, 18 m beside the head and beyond the fan. Elements half a wavelength apart receive it in beams of
// the other side, at frequencies beside the pulse's. It is louder there than the bed, which is found nevertheless.
// Where both echoes coincide, the position is right and the echo is not.
TEST(JudgedSoundings, of_a_harbour_with_a_quay_beside_the_fan) {
  const SceneCloud harbour = make_built_in_scene("harbour", {.points = 200000});
  const SceneCloud dense = make_built_in_scene("harbour", {.points = 1000000});
  const Surface surface(dense);
  for (const char* sonar : {"em2040", "r2sonic-2024"}) {
    Judged j = judged(harbour, surface, head_below(sonar, 26), {13.6, 2, -0.5}, 9.2, 4);
    EXPECT_GT(j.right, 0.97 * j.found) << sonar;
    j.right_rejected -= j.right_in_lobes;
    EXPECT_LT(j.right_in_lobes, 0.03 * j.right) << sonar;
    expect_trusted(j);
  }
}
TEST(JudgedSoundings, of_a_plane) {
  const SceneCloud plane = make_built_in_scene("plane", {.points = 150000, .size = {12, 44}});
  for (const char* sonar : {"em2040", "r2sonic-2024"})
    expect_trusted(judged(plane, head_below(sonar, 20), {4, 0, 6}, 1.1, 3));
}

// A steel rod of 10 cm that stands 1 m high, and a mine of 50 cm, on sand 6 m below the head: each is found, and all
// that is found of it is kept.
TEST(JudgedSoundings, keep_single_targets_on_sand) {
  SceneCloud sand = make_built_in_scene("plane", {.points = 150000, .size = {6, 30}});
  sand.materials = {{"sand", power_from_db(-22)}, {"steel", power_from_db(-10)}};
  constexpr int turns = 24, heights = 50, rings = 30;
  for (int k = 0; k < turns; ++k) {
    const double turn = 2 * pi * k / turns;
    const Eigen::Vector3d out(std::cos(turn), std::sin(turn), 0);
    for (int h = 0; h < heights; ++h)
      add_surfel(sand, {3 + 0.05 * out.x(), 3 + 0.05 * out.y(), (h + 0.5) / heights}, out,
                 2 * pi * 0.05 / turns / heights, 1);
    for (int r = 0; r < rings; ++r) {
      const double up = pi * (r + 0.5) / rings;
      const Eigen::Vector3d normal = std::sin(up) * out + std::cos(up) * Eigen::Vector3d::UnitZ();
      add_surfel(sand, Eigen::Vector3d(3, -2, 0.25) + 0.25 * normal, normal,
                 0.25 * 0.25 * std::sin(up) * (pi / rings) * (2 * pi / turns), 1);
    }
  }
  const Eigen::Vector3d start(3, 0, 6);
  for (const char* sonar : {"em2040", "r2sonic-2024"}) {
    const SonarHead head = head_below(sonar, 16);
    int on_rod = 0, on_mine = 0, rejected = 0;
    for (int p = 0; p < 3; ++p) {
      const BottomSoundings found = soundings_below(sand, head, start, p);
      for (std::size_t i = 0; i < found.size(); ++i) {
        const Eigen::Vector3d& at = found.position[i];
        // Consider beams whose axes meet the target; those beside it receive it through their skirts.
        const Eigen::Vector3d sight = (at - start).normalized(), middle(3, -2, 0.25);
        const bool rod = std::abs(at.y() - 3) <= 0.05 && at.z() > 0.1;
        const bool mine = sight.cross(middle - start).norm() < 0.25 && (at - middle).norm() < 0.3 && at.z() > 0.1;
        on_rod += rod, on_mine += mine, rejected += (rod || mine) && found.reject[i] != 0;
      }
    }
    std::printf("  %s: rod %d, mine %d, rejected %d\n", sonar, on_rod, on_mine, rejected);
    EXPECT_GT(on_rod, 0) << sonar;
    EXPECT_GT(on_mine, 6) << sonar;
    EXPECT_EQ(rejected, 0) << sonar;
  }
}
